#pragma once
#include <cstdint>
#include <memory>
#include <vector>
namespace demo::msg
{
struct Sample
{
  using ConstSharedPtr = std::shared_ptr<const Sample>;
  std::vector<float> value;
  std::int32_t code = 0;
};
}  // namespace demo::msg
