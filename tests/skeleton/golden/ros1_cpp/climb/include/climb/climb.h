// Send the take-off command. Says "when" \ it is there.
//
// This file is yours: it was written once. See climb_base.h for the base class.
// swarmc:fits f0e09b42
#ifndef CLIMB_CLIMB_H
#define CLIMB_CLIMB_H

#include <string>

#include <climb/climb_base.h>

namespace climb
{

/// Send the take-off command.
/// Says "when" \ it is there.
class Climb : public ClimbBase
{
public:
  /// goal.height : float64 - How high, in metres.
  /// result.reached : float64
  /// feedback.now : float64
  Outcome execute(const Goal& goal, Result& result, std::string& text) override;
  /// state
  void on_state(const demo::Sample& message) override;
};

}  // namespace climb

#endif  // CLIMB_CLIMB_H
