"""Packages and interfaces of ROS."""
