#pragma once
/// The body force of a known motion: a load on every node, for eight of them at a time, by all
/// threads.

#include "common/scheme/body/body.hpp"
#include "common/scheme/boundary/known_loads.hpp"
#include "common/scheme/budget/audit.hpp"

#include <memory>
#include <vector>

namespace diptych::scheme {

class BodyLoads {
 public:
  BodyLoads() = default;  ///< none
  /// @param X      [n_nodes] m, from the centre of moments
  /// @param Omega  [n_nodes] m^3
  BodyLoads(std::shared_ptr<KnownLoads> known,
            const std::vector<Vec3>& X,
            const std::vector<double>& Omega);

  bool is_there() const { return known_ != nullptr; }
  /// At the time of move_to().
  const KnownLoads& known() const {
    known_->move_to(time_);
    return *known_;
  }

  /// Moves to time t.
  void move_to(double t) { time_ = t; }
  double time() const { return time_; }
  /// Adds the forces to body.T. @return their power and their force and torque
  template <int Dim>
  LoadRates add_to(Body<Dim>& body) const;
  /// With the velocities as they are  [W]
  template <int Dim>
  double power(const Body<Dim>& body) const;

 private:
  template <int Dim>
  DIPTYCH_CLONES LoadRates add_blocks(const algebra::BlockField& forces,
                                      Body<Dim>& body,
                                      std::int64_t begin,
                                      std::int64_t end) const;
  template <int Dim>
  DIPTYCH_CLONES double power_of_blocks(const algebra::BlockField& forces,
                                        const Body<Dim>& body,
                                        std::int64_t begin,
                                        std::int64_t end) const;

  std::shared_ptr<KnownLoads> known_;
  double time_ = 0;                ///< s; others may have moved what is known since
  algebra::BlockField X_, Omega_;  ///< [3] m, [1] m^3; zero in the last lanes
};

}  // namespace diptych::scheme
