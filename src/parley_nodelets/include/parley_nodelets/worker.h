// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/timer.h>

#include <atomic>
#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace parley {

/// The one thread in which a node runs its stage: periodic work and posted work in turn, never two at a time. What the
/// work throws ends here: it is logged, counted, and answered by `on_error`.
class Worker {
 public:
  using Work = std::function<void()>;

  Worker(std::string name, Work on_error);
  /// Waits for the work that runs; what is queued is dropped.
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Starts the thread; nothing runs before. To be called when the node is complete.
  void start();
  /// Runs work every `period` seconds of ROS time.
  void every(const ros::NodeHandle& nh, double period, const Work& work);
  /// Runs work as soon as the thread is free.
  void post(Work work);
  /// Ends the thread: after this, none of the work runs again.
  void stop();

  int errors() const { return errors_; }

 private:
  void run(const Work& work);
  void loop();

  std::string name_;
  Work on_error_;
  ros::CallbackQueue queue_;
  std::vector<ros::Timer> timers_;
  std::atomic<bool> stopping_{false};
  std::atomic<int> errors_{0};
  std::thread thread_;
};

}  // namespace parley
