// A camera that sees what it is exposed to.
#include <camera/camera.h>

namespace camera
{

bool Camera::handle_snap(const demo::CameraSnap::Request& request, demo::CameraSnap::Response& response)
{
  response.stored = request.zoom < parameters().rate;
  return true;
}

void Camera::on_exposure(const std_msgs::Float64& message)
{
  demo::Sample sample;
  sample.value.push_back(static_cast<float>(message.data));
  outputs().seen.publish(sample);
}

void Camera::on_bus(const std_msgs::Bool& /*message*/)
{
}

}  // namespace camera
