// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <thread>

#include "datagram_file.h"
#include "parley_exchange/packet_codec.h"
#include "parley_exchange/seal.h"
#include "parley_exchange/udp_transport.h"

namespace {

using namespace parley;

const char* const kUsage =
    "usage: parley_dump KEY_FILE FILE | parley_dump KEY_FILE --port PORT\n"
    "Prints sealed packets: of a file (hexadecimal, one a line, or each after its length in two bytes, big-endian),\n"
    "or of a UDP port, until interrupted.\n";

struct Count {
  int opened = 0;
  int refused = 0;
};

void print(Sealer& sealer, const Bytes& frame, Count& count) {
  const auto header = readHeader(frame);
  const auto plain = header ? sealer.open(*header, frame) : std::nullopt;
  if (!plain) {
    ++count.refused;
    std::printf("%zu bytes: %s\n\n", frame.size(),
                header ? "not authentic: another key, or changed" : "no frame of this version");
    return;
  }
  ++count.opened;
  std::printf("%zu bytes: sender=%08x boot=%u counter=%u\n%s\n", frame.size(), header->sender, header->boot, header->counter,
              describe(decodePacket(*plain)).c_str());
}

[[noreturn]] void listen(Sealer& sealer, std::uint16_t port) {
  UdpSettings settings;
  settings.port = port;
  settings.share_port = true;
  const auto udp = openUdp(settings);
  Count count;
  for (;;) {
    for (const Bytes& frame : udp->receive(0.0)) print(sealer, frame, count);
    std::fflush(stdout);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

int run(int argc, char** argv) {
  const std::string key_file = argv[1], what = argv[2];
  Sealer sealer(loadTeamKey(key_file));
  if (what == "--port") {
    const std::string digits = argc == 4 ? argv[3] : "";
    if (digits.empty() || digits.size() > 5 || digits.find_first_not_of("0123456789") != std::string::npos ||
        std::stoul(digits) > 65535) {
      throw std::invalid_argument("--port: a number up to 65535 must follow");
    }
    listen(sealer, static_cast<std::uint16_t>(std::stoul(digits)));
  }
  Count count;
  for (const Bytes& frame : readDatagrams(what)) print(sealer, frame, count);
  std::fprintf(stderr, "%d packets opened, %d refused\n", count.opened, count.refused);
  return count.opened > 0 || count.refused == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3 || argc > 4) {
    std::fputs(kUsage, stderr);
    return 2;
  }
  try {
    return run(argc, argv);
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
