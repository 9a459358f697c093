// Send the take-off command. Says "when" \ it is there.
//
// This file is yours: it was written once. See climb_base.h for the base class.
// swarmc:fits f0e09b42
#include <climb/climb.h>

namespace climb
{

Climb::Outcome Climb::execute(const Goal& /*goal*/, Result& /*result*/, std::string& text)
{
  while (!cancelled())
  {
    // Process it here, with wait(0.1) between two steps, and return Outcome::succeeded at its end.
    text = "climb is not implemented";
    return Outcome::aborted;
  }
  return Outcome::preempted;
}

void Climb::on_state(const demo::Sample& /*message*/)
{
}

}  // namespace climb
