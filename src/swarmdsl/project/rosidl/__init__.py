"""ROS interface types: those in interface files, and those that ROS itself comes with."""
