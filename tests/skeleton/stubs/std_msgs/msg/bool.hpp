#pragma once
#include <memory>
namespace std_msgs::msg
{
struct Bool
{
  using ConstSharedPtr = std::shared_ptr<const Bool>;
  bool data = {};
};
}  // namespace std_msgs::msg
