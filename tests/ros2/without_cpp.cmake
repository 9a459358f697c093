# Interfaces for Python alone, which takes half the time: what makes C++ of them is struck off the list
# of generators before a package asks for them (ament_cmake_core, ament_execute_extensions).
find_package(ament_cmake REQUIRED)
find_package(rosidl_default_generators REQUIRED)
list(FILTER AMENT_EXTENSIONS_rosidl_generate_idl_interfaces EXCLUDE REGEX "_cpp:")
