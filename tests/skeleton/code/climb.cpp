// A climb that ends in each way, by the height that is asked for.
#include <climb/climb.h>

#include <stdexcept>

namespace climb
{

Climb::Outcome Climb::execute(const Goal& goal, Result& result, std::string& text)
{
  if (goal.height == 1)
  {
    Feedback feedback;
    feedback.now = 0.5;
    publish_feedback(feedback);
    wait(0.1);
    if (const auto state = inputs().state)
    {
      outputs().pos_goal_position.publish(state);
    }
    result.reached = goal.height + parameters().tolerance;
    return Outcome::succeeded;
  }
  if (goal.height == 2)
  {
    throw std::invalid_argument("too high");
  }
  if (goal.height == 4)
  {
    throw 4;
  }
  while (wait(0.02))
  {
  }
  text = "left";
  return Outcome::preempted;
}

void Climb::on_state(const demo::Sample& /*message*/)
{
}

}  // namespace climb
