// Tests of node climb. This file is yours: it was written once.
// swarmc:fits 0b32bd73
#include <gtest/gtest.h>

#include "climb/climb.hpp"

namespace climb
{

class ClimbTest : public testing::Test
{
protected:
  void SetUp() override
  {
    rclcpp::init(0, nullptr);
    rclcpp::NodeOptions options;
    options.append_parameter_override("frame", std::string("map"));
    node = std::make_shared<Climb>(options);
  }

  void TearDown() override
  {
    node->stop();
    node.reset();
    rclcpp::shutdown();
  }

  std::shared_ptr<Climb> node;
};

TEST_F(ClimbTest, AGoalEnds)
{
  Climb::Result result;
  std::string text;
  // Until it is implemented.
  EXPECT_EQ(Climb::Outcome::aborted, node->execute({}, result, text));
}

TEST_F(ClimbTest, on_state)
{
  EXPECT_NO_THROW(node->on_state({}));
}

}  // namespace climb
