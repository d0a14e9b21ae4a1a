// SPDX-License-Identifier: BSD-3-Clause
#include "parley_exchange/udp_transport.h"

#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/udp.hpp>
#include <boost/asio/ip/unicast.hpp>
#include <boost/asio/socket_base.hpp>
#include <cassert>
#include <stdexcept>

#include "parley_exchange/seal.h"

namespace parley {
namespace {

using boost::asio::ip::udp;

constexpr int kMaxAtOnce = 1000;  // [-] datagrams received in one call

boost::asio::ip::address_v4 addressOf(const std::string& text) {
  boost::system::error_code error;
  auto address = boost::asio::ip::make_address_v4(text, error);
  if (error) throw std::invalid_argument("udp: '" + text + "' is no IPv4 address");
  return address;
}

udp::endpoint endpointOf(const std::string& text, std::uint16_t port) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) return {addressOf(text), port};
  const std::string digits = text.substr(colon + 1);
  const bool is_number = !digits.empty() && digits.size() <= 5 && digits.find_first_not_of("0123456789") == std::string::npos;
  const unsigned long number = is_number ? std::stoul(digits) : 0;
  if (number == 0 || number > 65535) throw std::invalid_argument("udp: '" + text + "' has no port from 1 to 65535");
  return {addressOf(text.substr(0, colon)), static_cast<std::uint16_t>(number)};
}

class UdpTransport : public Transport {
 public:
  explicit UdpTransport(const UdpSettings& settings) : socket_(context_) {
    const udp::endpoint local(addressOf(settings.local), settings.port);
    for (const std::string& peer : settings.peers) destinations_.push_back(endpointOf(peer, settings.port));
    if (settings.peers.empty()) destinations_.emplace_back(addressOf(settings.broadcast), settings.port);
    try {
      socket_.open(udp::v4());
      socket_.set_option(boost::asio::socket_base::reuse_address(settings.share_port));
      socket_.set_option(boost::asio::socket_base::broadcast(settings.peers.empty()));
      if (settings.peers.empty()) socket_.set_option(boost::asio::ip::unicast::hops(1));
      socket_.bind(local);
      socket_.non_blocking(true);
    } catch (const boost::system::system_error& error) {
      throw std::invalid_argument("udp: " + settings.local + ":" + std::to_string(settings.port) + ": " + error.what());
    }
  }

  bool send(const Bytes& datagram, double /*now*/) override {
    problem_.clear();
    for (const udp::endpoint& destination : destinations_) {
      boost::system::error_code error;
      socket_.send_to(boost::asio::buffer(datagram), destination, 0, error);
      if (error) problem_ = destination.address().to_string() + ": " + error.message();
    }
    return problem_.empty();
  }

  std::vector<Bytes> receive(double /*now*/) override {
    std::vector<Bytes> datagrams;
    problem_.clear();
    for (int i = 0; i < kMaxAtOnce; ++i) {
      udp::endpoint from;
      boost::system::error_code error;
      const std::size_t size = socket_.receive_from(boost::asio::buffer(buffer_), from, 0, error);
      if (error == boost::asio::error::would_block || error == boost::asio::error::try_again) break;
      // A peer that is not there yet answers unicast with a refusal; that is no reason to stop listening.
      if (error) {
        problem_ = error.message();
      } else {
        datagrams.emplace_back(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(size));
      }
    }
    return datagrams;
  }

  std::string problem() const override { return problem_; }
  std::uint16_t port() const { return socket_.local_endpoint().port(); }

 private:
  boost::asio::io_context context_;
  udp::socket socket_;
  std::vector<udp::endpoint> destinations_;
  // One byte more than any packet has, so that what is too long is seen to be so.
  std::array<std::uint8_t, kMaxDatagram + 1> buffer_{};
  std::string problem_;
};

}  // namespace

std::unique_ptr<Transport> openUdp(const UdpSettings& settings) { return std::make_unique<UdpTransport>(settings); }

std::uint16_t boundPort(const Transport& udp) {
  const auto* transport = dynamic_cast<const UdpTransport*>(&udp);
  assert(transport != nullptr);
  return transport->port();
}

}  // namespace parley
