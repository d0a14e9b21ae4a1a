// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <csignal>

namespace parley {

/// Lets a process end in order: SIGINT, SIGTERM and a master's or rosnode's shutdown request end `wait()` while ROS
/// still runs, so that the last command to stand goes out. roscpp's own handlers would have closed all topics by then.
class CleanExit {
 public:
  /// Before ros::init, in the main thread, before any other thread starts; ros::init then needs NoSigintHandler.
  CleanExit();

  /// Takes over shutdown requests by XML-RPC. After ros::start.
  void answerShutdownRequests();

  /// Returns when the process is to end.
  void wait();

  /// Gives what was published last the time to leave the sockets, then shuts ROS down.
  static void shutdown();

 private:
  sigset_t signals_;
  std::atomic<bool> requested_{false};
};

}  // namespace parley
