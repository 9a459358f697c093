// Sends a request to a camera that is not implemented and runs on the stubs.
#include <cstdio>

#include "camera/camera.hpp"

using Service = rclcpp::Service<demo::srv::CameraSnap>;

static std::shared_ptr<Service> find(camera::Camera & node)
{
  const auto found = std::static_pointer_cast<Service>(node.services.at("~/snap").lock());
  std::printf("%s\n", found ? "offered" : "withdrawn");
  return found;
}

int main()
{
  rclcpp::init(0, nullptr);
  auto node = std::make_shared<camera::Camera>();
  auto service = find(*node);
  service->deferring_callback(
    service, std::make_shared<rmw_request_id_t>(),
    std::make_shared<demo::srv::CameraSnap::Request>());
  std::printf("%d responses\n", static_cast<int>(service->responses.size()));
  service.reset();
  find(*node);
  node->timers.at(0)->callback();
  find(*node);
  return 0;
}
