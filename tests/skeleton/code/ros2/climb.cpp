// A climb that ends in each way, by the height that is asked for.
#include "climb/climb.hpp"

#include <stdexcept>

namespace climb
{

Climb::Outcome Climb::execute(const Goal & goal, Result & result, std::string & text)
{
  if (goal.height == 1) {
    publish_feedback(Feedback());
    result.reached = goal.height + parameters().tolerance;
    return Outcome::succeeded;
  }
  if (goal.height == 2) {
    throw std::invalid_argument("too high");
  }
  if (goal.height == 4) {
    throw 4;
  }
  while (wait(0.01)) {
  }
  text = "left";
  return Outcome::preempted;
}

void Climb::on_state(const demo::msg::Sample & message)
{
  outputs().pos_goal_position->publish(message);
}

}  // namespace climb
