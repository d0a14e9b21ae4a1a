// SPDX-License-Identifier: BSD-3-Clause
// Robots in processes of their own, with clocks of their own, that have nothing in common but sockets and a key.
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <thread>

#include "parley_exchange/exchange.h"
#include "parley_exchange/udp_transport.h"
#include "team.h"

namespace parley {
namespace {

constexpr std::size_t kRobots = 3;
constexpr int kWalls = 12;             // [-] of each robot
constexpr double kPatience = 30.0;     // [s]
constexpr double kClocksDiffer = 1e3;  // [s]

double steadyTime() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

std::string nameOf(std::size_t robot) { return "robot_" + std::to_string(robot); }

UdpSettings onThisMachine(std::uint16_t port) {
  UdpSettings settings;
  settings.local = "127.0.0.1";
  settings.port = port;
  return settings;
}

/// Ports that are free a moment before they are used.
std::array<std::uint16_t, kRobots> freePorts() {
  std::array<std::unique_ptr<Transport>, kRobots> sockets;
  std::array<std::uint16_t, kRobots> ports{};
  for (std::size_t i = 0; i < kRobots; ++i) {
    sockets[i] = openUdp(onThisMachine(0));
    ports[i] = boundPort(*sockets[i]);
  }
  return ports;
}

/// One robot, which publishes walls and takes in what comes.
class Robot {
 public:
  Robot(std::size_t index, const std::array<std::uint16_t, kRobots>& ports) : index_(index) {
    UdpSettings settings = onThisMachine(ports[index]);
    for (const std::uint16_t port : ports) {
      if (port != ports[index]) settings.peers.push_back("127.0.0.1:" + std::to_string(port));
    }
    udp_ = openUdp(settings);
  }

  void turn() {
    const double now = steadyTime() + kClocksDiffer * static_cast<double>(index_);
    for (const Bytes& datagram : udp_->receive(now)) exchange_.addPacket(datagram, now);
    exchange_.setOdometry(standing({}, now), DriveState::kStopped);
    std::vector<OwnContour> walls;
    for (int k = 0; k < kWalls; ++k) walls.push_back(wall(k, 1.0 + static_cast<double>(index_), 0.5 * k, 2.0, now));
    exchange_.publishContours(walls, now);
    for (const Bytes& packet : exchange_.step(now).packets) udp_->send(packet, now);
  }

  /// What it holds of all, the same text for the same records; empty while something is missing.
  std::string holdings() const {
    std::string text;
    for (std::size_t of = 0; of < kRobots; ++of) {
      std::vector<SharedContour> contours = exchange_.contoursOf(robotIdOf(nameOf(of)));
      if (contours.size() != kWalls) return "";
      std::sort(contours.begin(), contours.end(),
                [](const SharedContour& a, const SharedContour& b) { return a.name.id < b.name.id; });
      for (const SharedContour& contour : contours) {
        text += std::to_string(of) + ":" + std::to_string(contour.name.id) + "." + std::to_string(contour.name.sequence);
        for (const Eigen::Vector2d& p : contour.polygon) text += " " + std::to_string(p.x()) + "," + std::to_string(p.y());
        text += "\n";
      }
    }
    return text;
  }

 private:
  static ExchangeIdentity identity(std::size_t index) {
    return {nameOf(index), 1, simulatedTeamKey(3), {0.8, 0.4}, {2.0, 1.5708, 2.0, 4.0}};
  }

  std::size_t index_;
  std::unique_ptr<Transport> udp_;
  Exchange exchange_{ExchangeOptions{}, identity(index_)};
};

struct Pipe {
  Pipe() { EXPECT_EQ(::pipe(ends), 0); }
  int ends[2] = {-1, -1};
};

bool isClosed(int descriptor) {
  pollfd watch{descriptor, POLLIN, 0};
  return ::poll(&watch, 1, 0) > 0;
}

/// A robot's process: tells what it holds once it has all, and goes on, for the others' sake, until `stop` is closed.
int live(std::size_t index, const std::array<std::uint16_t, kRobots>& ports, int tell, int stop) {
  Robot robot(index, ports);
  bool told = false;
  for (const double end = steadyTime() + kPatience; steadyTime() < end && !isClosed(stop);) {
    robot.turn();
    const std::string holdings = told ? "" : robot.holdings();
    if (!holdings.empty()) {
      const std::string text = holdings + '\0';
      told = ::write(tell, text.data(), text.size()) == static_cast<ssize_t>(text.size());
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return told ? 0 : 1;
}

/// What a process tells, up to a zero; what came till then if it ends before.
std::string readText(int descriptor) {
  std::string text;
  for (char c = 0; ::read(descriptor, &c, 1) == 1 && c != '\0';) text += c;
  return text;
}

}  // namespace

TEST(TeamUdp, threeProcessesComeToHoldTheSame) {
  const auto ports = freePorts();
  std::array<Pipe, kRobots> tell;
  Pipe stop;
  std::array<pid_t, kRobots> processes{};
  for (std::size_t i = 0; i < kRobots; ++i) {
    processes[i] = ::fork();
    ASSERT_GE(processes[i], 0);
    if (processes[i] > 0) {
      ::close(tell[i].ends[1]);
      continue;
    }
    ::close(stop.ends[1]);
    ::_exit(live(i, ports, tell[i].ends[1], stop.ends[0]));
  }
  std::array<std::string, kRobots> holdings;
  for (std::size_t i = 0; i < kRobots; ++i) holdings[i] = readText(tell[i].ends[0]);
  ::close(stop.ends[1]);
  for (std::size_t i = 0; i < kRobots; ++i) {
    int status = 0;
    EXPECT_EQ(::waitpid(processes[i], &status, 0), processes[i]);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << nameOf(i) << " did not get everything in " << kPatience << " s";
    EXPECT_FALSE(holdings[i].empty());
    EXPECT_EQ(holdings[i], holdings[0]);
  }
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
