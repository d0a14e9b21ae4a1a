# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash
# Sourced by every script here, for a desk or a build server; a robot's own roscore and address are set in its launch.

PARLEY_ROOT="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
export PARLEY_ROOT

# ROS's Python modules belong to the system's python3. Another one ahead on PATH (pyenv, conda, a virtual environment)
# breaks CMake's search for an interpreter as well as every node that starts with `env python3`.
export PATH="/usr/local/sbin:/usr/sbin:/usr/bin:/sbin:/bin:$PATH"
unset VIRTUAL_ENV CONDA_PREFIX PYTHONHOME

# Talk to this machine alone. rostest picks a free port for each master that it starts.
export ROS_IP=127.0.0.1
export ROS_MASTER_URI="${ROS_MASTER_URI:-http://127.0.0.1:11311}"
unset ROS_HOSTNAME

# Let a clone in another folder reuse what was compiled in this one.
export CCACHE_BASEDIR="$PARLEY_ROOT"
export CCACHE_NOHASHDIR=1

# Jobs at a time. A translation unit that instantiates PCL takes 1 GB.
export PARLEY_JOBS="${PARLEY_JOBS:-$(nproc)}"

# stage TEXT: a line with the time, so that a log shows where the minutes went.
stage() {
  printf '\n[%s] %s\n' "$(date +%H:%M:%S)" "$*"
}
