// Send the take-off command. Says "when" \ it is there.
//
// This file is yours: it was written once. See climb_base.hpp for the base class.
// swarmc:fits 0b32bd73
#ifndef CLIMB_CLIMB_HPP_
#define CLIMB_CLIMB_HPP_

#include <string>

#include "climb/climb_base.hpp"

namespace climb
{

/// Send the take-off command.
/// Says "when" \ it is there.
class Climb : public ClimbBase
{
public:
  using ClimbBase::ClimbBase;

  /// goal.height : float64 - How high, in metres.
  /// result.reached : float64
  /// feedback.now : float64
  Outcome execute(const Goal & goal, Result & result, std::string & text) override;

  /// state
  void on_state(const demo::msg::Sample & message) override;
};

}  // namespace climb

#endif  // CLIMB_CLIMB_HPP_
