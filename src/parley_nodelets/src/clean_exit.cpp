// SPDX-License-Identifier: BSD-3-Clause
#include "parley_nodelets/clean_exit.h"

#include <pthread.h>
#include <ros/init.h>
#include <ros/xmlrpc_manager.h>

#include <chrono>
#include <thread>

namespace parley {
namespace {

constexpr long kLookEvery = 100'000'000;             // [ns]
constexpr std::chrono::milliseconds kSendTime(100);  // for one small message per subscriber

}  // namespace

CleanExit::CleanExit() {
  // Blocked signals are inherited by all threads and collected in wait(): no handler, no global.
  sigemptyset(&signals_);
  sigaddset(&signals_, SIGINT);
  sigaddset(&signals_, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
}

void CleanExit::answerShutdownRequests() {
  const auto answer = [this](XmlRpc::XmlRpcValue&, XmlRpc::XmlRpcValue& result) {
    requested_ = true;
    result = ros::xmlrpc::responseInt(1, "", 0);
  };
  ros::XMLRPCManager::instance()->unbind("shutdown");
  ros::XMLRPCManager::instance()->bind("shutdown", answer);
}

void CleanExit::wait() {
  const timespec look{0, kLookEvery};
  while (!requested_ && ros::ok()) {
    if (sigtimedwait(&signals_, nullptr, &look) > 0) return;
  }
}

void CleanExit::shutdown() {
  std::this_thread::sleep_for(kSendTime);
  ros::shutdown();
}

}  // namespace parley
