# SPDX-License-Identifier: BSD-3-Clause
"""Topic and service names are relative, so that a namespace moves a whole robot; what ROS itself holds absolute may stay."""
import re

import cpp

SUFFIXES = (".h", ".cpp", ".py")
ABSOLUTE_BY_CONVENTION = ("/clock", "/tf", "/tf_static", "/rosout", "/diagnostics")
CALL = re.compile(r"\b(?:advertise|subscribe|serviceClient|advertiseService|Publisher|Subscriber|ServiceProxy|Service"
                  r"|waitForMessage|wait_for_message|SimpleActionClient)\b\s*(?:<[^;(){}]*>)?\s*\(\s*(?:\w+,\s*)?[\"'](/[^\"']*)")


def check(path, text):
    if "/src/" not in f"/{path.as_posix()}":
        return
    text = text if path.suffix == ".py" else cpp.without_comments(text)
    for match in CALL.finditer(text):
        if match[1] not in ABSOLUTE_BY_CONVENTION:
            yield text.count("\n", 0, match.start(1)) + 1, f"absolute name {match[1]}", True
