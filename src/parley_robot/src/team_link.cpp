// SPDX-License-Identifier: BSD-3-Clause
#include "parley_robot/team_link.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdio>
#include <utility>

#include "parley_geometry/polygon.h"

namespace parley {
namespace {

constexpr double kKeyframeSpacing = 1.5;   // [m] between keyframes that are told
constexpr double kToldSpan = 1.0;          // [s] of sightings that are told
constexpr double kMapPeriod = 1.0;         // [s] between two tellings and two drawings of maps
constexpr double kHardSigma = 0.15;        // [m] outlines known better than this are obstacles,
constexpr double kHardStays = 0.2;         // [m] and stay so up to here
constexpr double kSoftSigma = 0.6;         // [m] outlines less certain than this are of no use
constexpr double kMovedBy = 0.05;          // [m] of outlines some metres off: they are drawn anew
constexpr double kMovedYaw = 0.01;         // [rad]
constexpr double kStillSeen = 5.0;         // [s] what own sensing has seen since stays when somebody else sees through it
constexpr double kFreshTrajectory = 3.0;   // [s] a body is where it said that it would be, not longer ago than this,
constexpr double kFreshBeacon = 0.5;       // [s] else where its last beacon, younger than this, says
constexpr std::size_t kMostCorners = 15;   // [-] of a way that is told
constexpr double kCornerTolerance = 0.08;  // [m]
constexpr double kLostTeammate = 6.0;      // [s] a robot whose place is unknown may still be near when it was last heard
constexpr double kRadioWorked = 30.0;      // [s] since a teammate was heard well
constexpr double kGoodLink = 0.6;          // [-] share of its packets
constexpr double kBodyMargin = 0.05;       // [m] beyond the pose's deviation

/// What relative localization calls a robot.
std::string nameOf(RobotId id) {
  char text[16];
  std::snprintf(text, sizeof(text), "%08x", id);
  return text;
}

/// The corners of a way that say it to within a few centimetres, as many as can be told.
std::vector<Eigen::Vector2d> cornersOf(const std::vector<Eigen::Vector2d>& way) {
  if (way.size() < 3) return way;
  std::vector<Eigen::Vector2d> corners = {way.front()};
  for (std::size_t from = 0; from + 1 < way.size() && corners.size() < kMostCorners;) {
    std::size_t to = from + 1;
    const auto straight = [&](std::size_t end) {
      for (std::size_t i = from + 1; i < end; ++i) {
        if (pointSegmentDistance(way[i], way[from], way[end]) > kCornerTolerance) return false;
      }
      return true;
    };
    while (to + 1 < way.size() && straight(to + 1)) ++to;
    corners.push_back(way[to]);
    from = to;
  }
  return corners;
}

double deviation(const Eigen::Matrix2d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(covariance, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, solver.eigenvalues().maxCoeff()));
}

EdgeState edgeStateOf(PoseState state) {
  if (state == PoseState::kConfirmed) return EdgeState::kConfirmed;
  return state == PoseState::kTentative ? EdgeState::kTentative : EdgeState::kWithdrawn;
}

ObservationMessage observationsOf(const SightReport& report, double now) {
  ObservationMessage message{std::max(0.0, now - report.stamp), report.T_odom_scan, {}};
  for (const SightedBlob& blob : report.blobs) {
    message.blobs.push_back({blob.position.norm(), std::atan2(blob.position.y(), blob.position.x()), blob.chord});
  }
  return message;
}

SightReport reportOf(const PeerObservations& sights) {
  SightReport report{sights.stamp, sights.pose, {}};
  for (const Observation& o : sights.blobs) {
    report.blobs.push_back({{o.range * std::cos(o.bearing), o.range * std::sin(o.bearing)}, o.chord});
  }
  return report;
}

}  // namespace

TeamLink::TeamLink(const ExchangeOptions& exchange, const RelativeLocalizationOptions& relative_localization,
                   const ExchangeIdentity& identity, bool share_maps)
    : share_maps_(share_maps),
      exchange_(exchange, identity),
      localization_(relative_localization, nameOf(robotIdOf(identity.name)), identity.footprint) {}

void TeamLink::addPacket(const Packet& packet, double now) { exchange_.addPacket(packet.bytes, now); }

void TeamLink::addScan(const Pose2& T_odom_base, const ObstacleScan& scan, double now) {
  localization_.addOwnScan(T_odom_base, scan);
  for (const Keyframe& keyframe : localization_.keyframes()) {  // newest first
    const bool far = !told_keyframe_ || (*told_keyframe_ - keyframe.T_odom_scan.position()).norm() > kKeyframeSpacing;
    if (far && exchange_.publishKeyframe(keyframe.descriptor, keyframe.T_odom_scan, keyframe.stamp, now)) {
      told_keyframe_ = keyframe.T_odom_scan.position();
    }
    break;
  }
  std::vector<ObservationMessage> told;
  for (const SightReport& report : localization_.sights(now - kToldSpan)) {
    told.insert(told.begin(), observationsOf(report, now));  // the newest first
  }
  exchange_.setObservations(told, now);
}

void TeamLink::hear(const PeerState& peer, double now) {
  Teammate& teammate = teammates_[peer.id];
  teammate.id = peer.id;
  if (!peer.name.empty()) teammate.name = peer.name;
  if (!peer.clock_known) return;
  Heard& heard = heard_[peer.id];
  const std::string name = nameOf(peer.id);
  if (peer.odometry.stamp > heard.motion) {
    heard.motion = peer.odometry.stamp;
    localization_.addPeerMotion(name, {peer.odometry.stamp, peer.odometry.pose, peer.odometry.twist, peer.footprint,
                                       travelOf(peer.id, peer.odometry.pose)});
  }
  for (const PeerObservations& sights : exchange_.observationsOf(peer.id, now)) {
    if (sights.received > heard.sights) localization_.addPeerSights(name, reportOf(sights));
  }
  heard.sights = now;
  for (const SharedKeyframe& keyframe : exchange_.keyframesOf(peer.id, now)) {
    if (keyframe.id < heard.next_keyframe) continue;
    heard.next_keyframe = keyframe.id + 1;
    localization_.addPeerKeyframe(name, {static_cast<int>(keyframe.id), keyframe.stamp, keyframe.pose, keyframe.descriptor});
  }
}

/// Way of a robot by its anchors: an odometer that all who hear it read alike. [m]
double TeamLink::travelOf(RobotId origin, const Pose2& T_odom_base) const {
  double travel = 0.0;
  const SharedAnchor* last = nullptr;
  const std::vector<SharedAnchor> anchors = exchange_.anchorsOf(origin);
  for (const SharedAnchor& anchor : anchors) {
    if (last) travel += (anchor.pose.position() - last->pose.position()).norm();
    last = &anchor;
  }
  return last ? travel + (T_odom_base.position() - last->pose.position()).norm() : travel;
}

std::optional<TeamLink::AnchorPlace> TeamLink::anchorPlace(RobotId origin, std::uint32_t id) const {
  AnchorPlace place;
  const SharedAnchor* last = nullptr;
  const std::vector<SharedAnchor> anchors = exchange_.anchorsOf(origin);
  for (const SharedAnchor& anchor : anchors) {
    if (last) place.travel += (anchor.pose.position() - last->pose.position()).norm();
    last = &anchor;
    place.pose = anchor.pose;
    if (anchor.id == id) return place;
  }
  return std::nullopt;
}

void TeamLink::hearEdges() {
  for (const SharedEdge& shared : exchange_.edges()) {
    if (shared.origin == exchange_.id() || shared.edge.state != EdgeState::kConfirmed) continue;
    double& written = edges_.try_emplace({shared.origin, shared.edge.peer}, -1e9).first->second;
    if (shared.written <= written + 0.5) continue;  // ages are told to 12 %
    const std::optional<AnchorPlace> from = anchorPlace(shared.origin, shared.edge.anchor);
    const std::optional<AnchorPlace> to = anchorPlace(shared.edge.peer, shared.edge.peer_anchor);
    if (!from || !to) continue;
    written = shared.written;
    localization_.addEdge({nameOf(shared.origin), nameOf(shared.edge.peer), shared.written, from->pose, to->pose, from->travel,
                           to->travel, shared.edge.T_anchor_peer});
    teammates_[shared.origin].id = shared.origin;
    if (shared.edge.peer != exchange_.id()) teammates_[shared.edge.peer].id = shared.edge.peer;
  }
}

void TeamLink::locate(double now) {
  for (const PeerState& peer : exchange_.peers(now)) hear(peer, now);
  hearEdges();
  std::map<std::string, PeerEstimate> estimates;
  for (PeerEstimate& estimate : localization_.step(now)) estimates[estimate.peer] = std::move(estimate);
  for (auto& [id, teammate] : teammates_) {
    const auto found = estimates.find(nameOf(id));
    teammate.estimate = found == estimates.end() ? PeerEstimate{} : found->second;
    if (teammate.estimate.state == PoseState::kUnknown && !told_poses_.count(id)) continue;
    PeerPose pose{teammate.estimate.T_odom_peerodom, teammate.estimate.support, edgeStateOf(teammate.estimate.state),
                  teammate.estimate.direct};
    if (pose.state == EdgeState::kWithdrawn) {
      told_poses_.erase(id);
    } else {
      told_poses_.insert(id);
    }
    exchange_.setPeerPose(id, pose, now);
  }
}

bool TeamLink::mapIsDue(double now) const { return share_maps_ && now >= told_map_at_ + kMapPeriod; }

void TeamLink::tellMap(const std::vector<Contour>& contours, const std::vector<SeenThrough>& seen_through, double now) {
  if (!mapIsDue(now)) return;
  told_map_at_ = now;
  told_contours_.clear();
  std::vector<OwnContour> own;
  own.reserve(contours.size());
  const std::vector<std::int64_t> keys = contour_keys_.assign(contours);
  for (std::size_t i = 0; i < contours.size(); ++i) {
    const Contour& c = contours[i];
    own.push_back({keys[i], c.polygon, c.closed, c.hole, now});
    told_contours_.emplace(keys[i], c);
  }
  exchange_.publishContours(own, now);
  contest(seen_through, now);
}

void TeamLink::contest(const std::vector<SeenThrough>& seen_through, double now) {
  for (const SeenThrough& outline : seen_through) {
    for (const auto& [id, teammate] : teammates_) {
      if (nameOf(id) == outline.origin) exchange_.contest({id, outline.id, outline.version}, now);
    }
  }
}

/// How an origin's outlines can be used, if at all, by how well they are known where this robot is.
std::optional<bool> TeamLink::hardness(const Teammate& teammate, const Pose2& T_odom_base, bool was_hard) const {
  const PoseState state = teammate.estimate.state;
  if (state != PoseState::kConfirmed && state != PoseState::kTentative) return std::nullopt;
  const PoseEstimate& T = teammate.estimate.T_odom_peerodom;
  const double sigma = deviation(pointCovariance(T, T.pose.inverse() * T_odom_base.position()));
  if (sigma > kSoftSigma) return std::nullopt;
  return state == PoseState::kConfirmed && sigma < (was_hard ? kHardStays : kHardSigma);
}

/// An origin's outlines where its frame is believed to be, without those that are contested: these are noted.
LayerUpdate TeamLink::layerOf(RobotId origin, double now) {
  Drawn& drawn = drawn_[origin];
  LayerUpdate layer{nameOf(origin), 7, now, drawn.T_odom_peer, drawn.hard, {}};
  std::map<std::uint32_t, Pose2> anchors;
  for (const SharedAnchor& anchor : exchange_.anchorsOf(origin)) anchors[anchor.id] = anchor.pose;
  std::set<ContourVersion> contested;
  for (const SharedContour& contour : exchange_.contoursOf(origin)) {
    const auto anchor = anchors.find(contour.anchor);
    if (anchor == anchors.end()) continue;
    const Polygon polygon = transformed(anchor->second, contour.polygon);
    const ContourName& name = contour.name;
    if (!contour.contested) {
      layer.contours.push_back({polygon, contour.closed, contour.confirmed, name.id, name.sequence});
      layer.hops = std::min(layer.hops, std::max(1, contour.hops));
    } else if (contested.emplace(name.id, name.sequence); drawn.hard && !drawn.contested.count({name.id, name.sequence})) {
      refuted_.push_back({transformed(drawn.T_odom_peer, polygon), contour.closed, now - kStillSeen});
    }
  }
  drawn.contested = std::move(contested);
  return layer;
}

MapChanges TeamLink::drawMaps(const Pose2& T_odom_base, double now) {
  MapChanges changes;
  if (!share_maps_) return changes;
  for (const auto& [id, teammate] : teammates_) {
    Drawn& drawn = drawn_[id];
    const std::optional<bool> hard = hardness(teammate, T_odom_base, drawn.hard);
    if (!hard) {
      if (drawn.revision >= 0) changes.removed.push_back(nameOf(id));
      drawn = {};
      continue;
    }
    const Pose2& T = teammate.estimate.T_odom_peerodom.pose;
    const Pose2 change = drawn.T_odom_peer.inverse() * T;
    const bool moved = change.position().norm() > kMovedBy || std::abs(change.yaw) > kMovedYaw;
    const int revision = exchange_.mapRevision(id);
    if (revision == drawn.revision && *hard == drawn.hard && !moved) continue;
    if (drawn.revision >= 0 && now < drawn.at + kMapPeriod) continue;
    // New outlines come where the old ones lie: a map that shakes with each measurement is worked out anew each time.
    const Pose2 place = moved || drawn.revision < 0 ? T : drawn.T_odom_peer;
    drawn = {revision, place, *hard, now, std::move(drawn.contested)};
    changes.drawn.push_back(layerOf(id, now));
  }
  changes.refuted = std::exchange(refuted_, {});
  return changes;
}

std::vector<KnownTeammate> TeamLink::bodies(double now) const {
  std::vector<KnownTeammate> bodies;
  for (const PeerState& peer : exchange_.peers(now)) {
    const auto found = teammates_.find(peer.id);
    if (found == teammates_.end() || found->second.estimate.state != PoseState::kConfirmed || !peer.clock_known) continue;
    const double age = now - peer.odometry.stamp;
    const std::optional<PeerTrajectory> said = exchange_.trajectoryOf(peer.id, now);
    const bool drives_as_said = said && !said->trajectory.empty() && now - said->received < kFreshTrajectory;
    if (age > kFreshBeacon && !drives_as_said) continue;
    const Twist2& twist = peer.odometry.twist;
    const Pose2 pose =
        drives_as_said ? said->trajectory.at(now).pose : integrateTwist(peer.odometry.pose, twist.speed, twist.turn_rate, age);
    const PoseEstimate& T = found->second.estimate.T_odom_peerodom;
    bodies.push_back({T.pose * pose, peer.footprint, kBodyMargin + deviation(pointCovariance(T, pose.position()))});
  }
  return bodies;
}

std::vector<PeerMotion> TeamLink::motions(double now) const {
  std::vector<PeerMotion> motions;
  for (const PeerState& peer : exchange_.peers(now)) {
    const auto found = teammates_.find(peer.id);
    const std::optional<PeerTrajectory> said = exchange_.trajectoryOf(peer.id, now);
    const bool known = found != teammates_.end() && found->second.estimate.state == PoseState::kConfirmed;
    if (!known || !peer.clock_known || !said || said->trajectory.empty() || peer.name.empty()) continue;
    const PoseEstimate& T = found->second.estimate.T_odom_peerodom;
    PeerMotion motion{peer.id, peer.footprint, {}, said->received, 0.0, {{1.0, peer.id, 0}, {}}};
    std::vector<TrajectoryPoint> points = said->trajectory.points();
    for (TrajectoryPoint& point : points) point.pose = T.pose * point.pose;
    motion.sigma = deviation(pointCovariance(T, said->trajectory.at(now).pose.position()));
    motion.trajectory = SampledTrajectory(std::move(points));
    if (const std::optional<PeerIntent> told = exchange_.intentOf(peer.id)) {
      const IntentMessage& intent = told->intent;
      motion.intent.right = {intent.priority, intent.holder, intent.depth};
      for (const Eigen::Vector2d& corner : intent.way) motion.intent.way.emplace_back(T.pose * corner);
    }
    motions.push_back(std::move(motion));
  }
  return motions;
}

bool TeamLink::isTeamKnown(double now) const {
  bool radio_works = false;
  for (const PeerState& peer : exchange_.peers(now)) {
    const auto found = teammates_.find(peer.id);
    const bool known = found != teammates_.end() && found->second.estimate.state == PoseState::kConfirmed && peer.clock_known;
    const double silent = now - peer.last_heard;
    if (silent < kLostTeammate && !known) return false;
    radio_works = radio_works || (silent < kRadioWorked && peer.heard > kGoodLink);
  }
  return radio_works;
}

void TeamLink::setIntent(const Intent& intent) {
  IntentMessage message;
  message.priority = intent.right.priority;
  message.holder = intent.right.holder;
  message.depth = intent.right.depth;
  message.way = cornersOf(intent.way);
  exchange_.setIntent(message);
}

std::vector<Packet> TeamLink::step(double now, const Odometry& odometry, const SampledTrajectory& trajectory, DriveState state) {
  exchange_.setOdometry(odometry, state);
  exchange_.setTrajectory(trajectory.empty() ? SampledTrajectory::standing(odometry.pose, now) : trajectory, state);
  ExchangeOutput output = exchange_.step(now);
  for (const ExchangeEvent& event : output.events) {
    if (event.kind == ExchangeEventKind::kContourContested) {
      const auto told = told_contours_.find(event.contour);
      if (told != told_contours_.end()) refuted_.push_back({told->second.polygon, told->second.closed, now - kStillSeen});
    }
    if (event.kind != ExchangeEventKind::kPeerRestarted) continue;
    localization_.forget(nameOf(event.robot));
    heard_.erase(event.robot);
  }
  std::vector<Packet> packets;
  for (Bytes& bytes : output.packets) packets.push_back({std::move(bytes)});
  return packets;
}

}  // namespace parley
