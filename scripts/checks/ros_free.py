# SPDX-License-Identifier: BSD-3-Clause
"""The stages know nothing of ROS: no include, no dependency. (Debian's ROS headers would be found all the same.)"""
import re
import xml.etree.ElementTree as ElementTree
from pathlib import Path

STAGES = (Path(__file__).parent / "stages.txt").read_text(encoding="utf-8").split()
SIMULATOR = "src/parley_sim/"  # all of it but its node and the writer of bags
SUFFIXES = (".h", ".cpp", ".xml", ".txt")

ROS_PACKAGE = (r"(?:ros\w*|tf|tf2\w*|nodelet\w*|pluginlib|class_loader|dynamic_reconfigure|diagnostic_\w+|actionlib\w*"
               r"|\w+_msgs|std_srvs|message_\w+|cv_bridge|image_transport|pcl_ros|pcl_conversions|rviz|bond\w*|topic_tools)")
INCLUDE = re.compile(rf'^\s*#\s*include\s*[<"]({ROS_PACKAGE})/', re.M)
COMPONENT = re.compile(rf"\b({ROS_PACKAGE})\b")


def _is_stage(path):
    return any(f"src/{stage}/" in path.as_posix() for stage in STAGES)


def _is_engine(path):
    return SIMULATOR in path.as_posix() and not re.search(r"node|bag", path.as_posix().split(SIMULATOR)[1])


def check(path, text):
    if path.suffix in (".h", ".cpp") and (_is_stage(path) or _is_engine(path)):
        for match in INCLUDE.finditer(text):
            yield text.count("\n", 0, match.start(1)) + 1, f"includes {match[1]}", True
    elif _is_stage(path) and path.name == "package.xml":
        for element in ElementTree.fromstring(text):
            if element.tag.endswith("depend") and re.fullmatch(ROS_PACKAGE, element.text.strip()):
                yield 1, f"depends on {element.text.strip()}", True
    elif _is_stage(path) and path.name == "CMakeLists.txt":
        for match in re.finditer(r"find_package\(catkin\b([^)]*)\)", text):
            for name in COMPONENT.findall(match[1]):
                yield text.count("\n", 0, match.start()) + 1, f"finds {name}", True
