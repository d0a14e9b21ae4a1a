#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Plants what each check must find, and what it must leave alone."""
import unittest
from pathlib import Path

import comments
import cpp
import mutable_state
import ros_free
import sizes
import topics
import wellformed

LICENCE = "// SPDX-License-Identifier: BSD-3-Clause\n"


def errors(module, name, text):
    """The lines on which a check finds an error."""
    return [line for line, _, error in module.check(Path(name), text) if error]


class Cpp(unittest.TestCase):
    def names(self, text):
        return [(f.name, f.line, f.last_line) for f in cpp.scan(text)[0]]

    def test_finds_functions_of_all_kinds(self):
        text = """namespace a::b {
template <typename T>
class C final : public D<T> {
 public:
  C(int x, std::string s) noexcept : D<T>(x), x_{x}, s_(std::move(s)) {
    for (int i = 0; i < 3; ++i) { x_ += i; }
  }
  bool operator==(const C& other) const { return x_ == other.x_; }
  int get() const override { return [this] { return x_; }(); }
  enum class Kind { kA, kB };
  int x_{3};
};
auto f(Options options = {}) -> std::vector<int> {
  return {1, 2};
}
const auto g = [](int x) { return x; };
}  // namespace a::b
"""
        self.assertEqual(self.names(text), [("C", 5, 7), ("operator==", 8, 8), ("get", 9, 9), ("f", 13, 15)])

    def test_is_not_fooled_by_text(self):
        text = 'void f() {\n  s = "}{"; c = \'{\'; r = R"x(})" } )x";  // }\n  /* } */ n = 1\'000;\n}\n#define X {\nvoid g() {}\n'
        self.assertEqual(self.names(text), [("f", 1, 4), ("g", 6, 6)])


class Sizes(unittest.TestCase):
    def test_long_function(self):
        for lines, expected in ((58, []), (59, [1])):
            self.assertEqual(errors(sizes, "a.cpp", "void f() {\n" + "  x();\n" * lines + "}\n"), expected)
        self.assertEqual(errors(sizes, "a.py", "def f():\n" + "    x()\n" * 60), [1])

    def test_long_file(self):
        self.assertEqual(errors(sizes, "a.h", "\n" * 401), [1])
        self.assertEqual(errors(sizes, "a.h", "\n" * 400), [])


class MutableState(unittest.TestCase):
    def test_found(self):
        for text in ("int counter = 0;", "namespace { std::vector<int> cache; }", "static double last;",
                     "struct A { static int count; };", "void f() { static int n = 0; }",
                     "inline std::map<int, int> table = make(3);", "void f() { thread_local Engine engine; }"):
            self.assertEqual(errors(mutable_state, "a.cpp", text), [1], text)

    def test_left_alone(self):
        for text in ("constexpr int kN = 3;", "static const char kName[] = {1};", "int f(int x = 3);", "class A;",
                     "struct A { int x = 0; static A make(); static constexpr int kN = 1; };", "using B = int;",
                     "void f() { static const int n = g(); h(static_cast<int>(n)); }", "template <class T> T f();",
                     "PLUGINLIB_EXPORT_CLASS(a::B, c::D)", "static void f(int x) { int y = x; }",
                     "bool operator<(const A& a, const A& b);", "friend class B;"):
            self.assertEqual(errors(mutable_state, "a.cpp", text), [], text)


class RosFree(unittest.TestCase):
    def test_include(self):
        for header in ("ros/ros.h", "std_msgs/Header.h", "tf2/utils.h", "pcl_conversions/pcl_conversions.h"):
            text = f"#include <vector>\n#include <{header}>\n"
            self.assertEqual(errors(ros_free, "src/parley_lidar/src/a.cpp", text), [2])
            self.assertEqual(errors(ros_free, "src/parley_nodelets/src/a.cpp", text), [])
        self.assertEqual(errors(ros_free, "src/parley_lidar/src/a.cpp", "#include <pcl/point_types.h>\n"), [])

    def test_simulator(self):
        text = "#include <ros/ros.h>\n"
        self.assertEqual(errors(ros_free, "src/parley_sim/src/world.cpp", text), [1])
        self.assertEqual(errors(ros_free, "src/parley_sim/src/simulator_node.cpp", text), [])

    def test_package(self):
        text = "<package><depend>eigen</depend><depend>roscpp</depend></package>"
        self.assertEqual(errors(ros_free, "src/parley_control/package.xml", text), [1])
        text = "find_package(catkin REQUIRED COMPONENTS parley_geometry nav_msgs)"
        self.assertEqual(errors(ros_free, "src/parley_control/CMakeLists.txt", text), [1])


class Topics(unittest.TestCase):
    def test_names(self):
        for text, expected in (('nh.advertise<std_msgs::Bool>("/stop", 1);', [1]), ('nh.subscribe("/odom", 1, f);', [1]),
                               ('nh.advertise<std_msgs::Bool>("stop", 1);', []), ('// nh.subscribe("/odom", 1);', []),
                               ('nh.advertise<rosgraph_msgs::Clock>("/clock", 1);', [])):
            self.assertEqual(errors(topics, "src/parley_nodelets/src/a.cpp", text), expected, text)
        self.assertEqual(errors(topics, "src/a/b.py", "rospy.Subscriber('/odom', Odometry)"), [1])


class Comments(unittest.TestCase):
    def test_licence(self):
        self.assertEqual(errors(comments, "a.h", "#pragma once\n"), [1])
        self.assertEqual(errors(comments, "a.h", LICENCE), [])

    def test_interpreter(self):
        self.assertEqual(errors(comments, "a.py", "#!/usr/bin/env python3\n# SPDX-License-Identifier: BSD-3-Clause\n"), [1])

    def test_code(self):
        for code in ("x = f(y);", "return x;", "#include <vector>", "if (x) {", "}", "robot->stop();", "f(x);"):
            self.assertEqual(errors(comments, "a.cpp", f"{LICENCE}// {code}\n"), [2], code)
        for prose in ("The path, as in [1];", "Drops what is too old (see above).", "{a, b} in metres", "e.g. a; b"):
            self.assertEqual(errors(comments, "a.cpp", f"{LICENCE}/// {prose}\n"), [], prose)
        head = "# SPDX-License-Identifier: BSD-3-Clause\n"
        self.assertEqual(errors(comments, "a.py", head + "# x = 3\n"), [2])
        self.assertEqual(errors(comments, "a.py", head + "# Sorted by name.\n"), [])

    def test_unfinished(self):
        self.assertEqual(errors(comments, "a.cpp", LICENCE + "// TO" + "DO: more\n"), [2])


class WellFormed(unittest.TestCase):
    def test_faults(self):
        self.assertEqual(errors(wellformed, "a.yaml", "a: [1\n"), [1])
        self.assertEqual(errors(wellformed, "a.launch", "<launch><node></launch>"), [1])
        self.assertEqual(errors(wellformed, "a.py", "def f(:\n"), [1])
        self.assertEqual(errors(wellformed, "a.md", "\nsee /home" + "/anna/x\n"), [2])

    def test_sound(self):
        self.assertEqual(errors(wellformed, "a.yaml", "a: [1]\n---\nb: 2\n"), [])
        self.assertEqual(errors(wellformed, "a.launch", '<?xml version="1.0"?><launch/>'), [])


if __name__ == "__main__":
    unittest.main()
