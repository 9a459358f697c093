// What skeletons use of rclcpp_action: its signatures, and the states of a goal.
#ifndef STUB_RCLCPP_ACTION_HPP_
#define STUB_RCLCPP_ACTION_HPP_

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>

#include "rclcpp/rclcpp.hpp"

namespace rclcpp_action
{

using GoalUUID = std::array<std::uint8_t, 16>;
enum class GoalResponse : std::int8_t {REJECT = 1, ACCEPT_AND_EXECUTE = 2, ACCEPT_AND_DEFER = 3};
enum class CancelResponse : std::int8_t {REJECT = 1, ACCEPT = 2};

template<typename A>
class ServerGoalHandle
{
public:
  using Ended = std::shared_ptr<typename A::Result>;

  explicit ServerGoalHandle(const typename A::Goal & goal)
  : goal_(std::make_shared<typename A::Goal>(goal)) {}
  bool is_canceling() const {return now() == "canceling";}
  bool is_executing() const {return now() == "executing";}
  std::shared_ptr<const typename A::Goal> get_goal() const {return goal_;}
  void publish_feedback(std::shared_ptr<typename A::Feedback>) {}
  void execute() {go("accepted", "", "executing");}
  void succeed(Ended ended) {end("executing", "canceling", "succeeded", ended);}
  void abort(Ended ended) {end("executing", "canceling", "aborted", ended);}
  void canceled(Ended ended) {end("canceling", "", "canceled", ended);}
  // For who drives the stub.
  void cancel() {go("executing", "accepted", "canceling");}
  std::string now() const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return state_;
  }
  Ended ended() const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return ended_;
  }

private:
  // As rcl_action/goal_state_machine has them.
  void go(const std::string & one, const std::string & other, const std::string & to)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (state_ != one && state_ != other) {
      throw std::runtime_error("goal is " + state_ + ": it cannot become " + to);
    }
    state_ = to;
  }
  void end(const std::string & one, const std::string & other, const std::string & to, Ended ended)
  {
    go(one, other, to);
    const std::lock_guard<std::mutex> lock(mutex_);
    ended_ = std::move(ended);
  }
  mutable std::mutex mutex_;
  std::string state_ = "accepted";
  Ended ended_;
  std::shared_ptr<typename A::Goal> goal_;
};

template<typename A>
struct Server
{
  using SharedPtr = std::shared_ptr<Server<A>>;
  using Handle = std::shared_ptr<ServerGoalHandle<A>>;
  std::function<GoalResponse(const GoalUUID &, std::shared_ptr<const typename A::Goal>)> asked;
  std::function<CancelResponse(Handle)> cancelled;
  std::function<void(Handle)> accepted;
};

template<typename A, typename N>
typename Server<A>::SharedPtr create_server(
  N node, const std::string & name, decltype(Server<A>::asked) asked,
  decltype(Server<A>::cancelled) cancelled, decltype(Server<A>::accepted) accepted)
{
  auto made = std::make_shared<Server<A>>();
  made->asked = asked;
  made->cancelled = cancelled;
  made->accepted = accepted;
  node->actions[name] = made;
  return made;
}

}  // namespace rclcpp_action

#endif  // STUB_RCLCPP_ACTION_HPP_
