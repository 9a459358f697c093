#pragma once
namespace demo::action
{
struct Climb
{
  struct Goal
  {
    double height = 0;
  };
  struct Result
  {
    double reached = 0;
  };
  struct Feedback
  {
    double now = 0;
  };
};
}  // namespace demo::action
