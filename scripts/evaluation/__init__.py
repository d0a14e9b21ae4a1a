# SPDX-License-Identifier: BSD-3-Clause
"""Campaigns of fleet_run: what to run, and tables of what came out."""
