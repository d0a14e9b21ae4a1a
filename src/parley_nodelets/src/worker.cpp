// SPDX-License-Identifier: BSD-3-Clause
#include "parley_nodelets/worker.h"

#include <ros/console.h>

namespace parley {
namespace {

constexpr double kWake = 0.1;  // [s] wall time after which the thread looks whether it is to end

/// Work as roscpp queues it.
class QueuedWork : public ros::CallbackInterface {
 public:
  explicit QueuedWork(std::function<void()> work) : work_(std::move(work)) {}
  CallResult call() override {
    work_();
    return Success;
  }

 private:
  std::function<void()> work_;
};

}  // namespace

Worker::Worker(std::string name, Work on_error) : name_(std::move(name)), on_error_(std::move(on_error)) {}

Worker::~Worker() { stop(); }

void Worker::start() {
  thread_ = std::thread([this] { loop(); });
}

void Worker::every(const ros::NodeHandle& nh, double period, const Work& work) {
  ros::TimerOptions options(
      ros::Duration(period), [this, work](const ros::TimerEvent&) { run(work); }, &queue_);
  timers_.push_back(nh.createTimer(options));
}

void Worker::post(Work work) {
  queue_.addCallback(boost::make_shared<QueuedWork>([this, work = std::move(work)] { run(work); }));
}

void Worker::stop() {
  stopping_ = true;
  if (thread_.joinable()) thread_.join();
  for (ros::Timer& timer : timers_) timer.stop();
  timers_.clear();
  queue_.disable();
  queue_.clear();
}

void Worker::run(const Work& work) {
  try {
    work();
  } catch (const std::exception& error) {
    ++errors_;
    ROS_ERROR_STREAM_THROTTLE_NAMED(1.0, name_, name_ << ": " << error.what());
    on_error_();
  }
}

void Worker::loop() {
  while (!stopping_) queue_.callAvailable(ros::WallDuration(kWake));
}

}  // namespace parley
