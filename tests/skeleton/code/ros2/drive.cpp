// Sends goals to a climb that runs on the stubs, and prints how each of them ends.
#include <cstdio>
#include <memory>
#include <string>
#include <thread>

#include "climb/climb.hpp"

using Handle = std::shared_ptr<rclcpp_action::ServerGoalHandle<demo::action::Climb>>;
using Server = rclcpp_action::Server<demo::action::Climb>;

static void sleep() {std::this_thread::sleep_for(std::chrono::milliseconds(50));}

static Handle send(climb::Climb & node, double height)
{
  demo::action::Climb::Goal goal;
  goal.height = height;
  auto handle = std::make_shared<Handle::element_type>(goal);
  auto server = std::static_pointer_cast<Server>(node.actions.at("cmd/climb"));
  if (server->asked({}, handle->get_goal()) != rclcpp_action::GoalResponse::ACCEPT_AND_DEFER) {
    std::printf("refused\n");
  }
  server->accepted(handle);
  sleep();
  return handle;
}

static void print(const char * what, const Handle & handle)
{
  for (int i = 0; i < 100 && !handle->ended(); ++i) {
    sleep();
  }
  std::printf("%s %s", what, handle->now().c_str());
  std::printf(" %g\n", handle->ended() ? handle->ended()->reached : -1.0);
}

int main()
{
  rclcpp::init(0, nullptr);
  try {
    climb::Climb nothing;
    std::printf("started without a needed parameter\n");
  } catch (const std::exception & error) {
    std::printf("%s\n", error.what());
  }
  auto node = std::make_shared<climb::Climb>(
    rclcpp::NodeOptions().append_parameter_override("frame", std::string("map")));
  print("reached", send(*node, 1));
  print("raised", send(*node, 2));
  print("nothing", send(*node, 4));
  auto cancelled = send(*node, 3);
  cancelled->cancel();
  print("cancelled", cancelled);
  auto replaced = send(*node, 3);
  auto newer = send(*node, 1);
  print("replaced", replaced);
  print("newer", newer);
  auto early = std::make_shared<Handle::element_type>(demo::action::Climb::Goal());
  early->cancel();
  std::static_pointer_cast<Server>(node->actions.at("cmd/climb"))->accepted(early);
  print("early", early);
  auto heard = std::static_pointer_cast<rclcpp::Subscription<demo::msg::Sample>>(
    node->subscriptions.at("state"));
  heard->callback(std::make_shared<demo::msg::Sample>());
  // A signal shuts down ROS, as in the node.
  rclcpp::contexts::get_global_default_context()->add_pre_shutdown_callback(
    [&node]() {std::printf("ended %d\n", node->end_goal());});
  auto running = send(*node, 3);
  rclcpp::shutdown();
  print("stopped", running);
  node->stop();
  return 0;
}
