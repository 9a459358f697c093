// Tests of node climb. This file is yours: it was written once.
// swarmc:fits f0e09b42
#include <climb/climb.h>
#include <gtest/gtest.h>

namespace climb
{

TEST(Climb, AGoalEnds)
{
  Climb node;
  Climb::Result result;
  std::string text;
  // Until it is implemented; without ROS, goals end at once.
  EXPECT_NE(Climb::Outcome::succeeded, node.execute({}, result, text));
}

TEST(Climb, on_state)
{
  Climb node;
  EXPECT_NO_THROW(node.on_state({}));
}

}  // namespace climb

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::Time::init();
  return RUN_ALL_TESTS();
}
