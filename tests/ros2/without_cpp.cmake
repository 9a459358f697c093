# Interfaces for Python alone, which takes half the time: what makes C++ of them is struck off the list
# of generators before a package asks for them (ament_cmake_core, ament_execute_extensions).
find_package(ament_cmake REQUIRED)
find_package(rosidl_default_generators REQUIRED)
list(FILTER AMENT_EXTENSIONS_rosidl_generate_idl_interfaces EXCLUDE REGEX "_cpp:")

# The headers of these sources take longest to compile: the sources together read them once.
function(compile_together)
  foreach(library rosidl_typesupport_fastrtps_c rosidl_typesupport_c)
    if(TARGET ${PROJECT_NAME}__${library})
      set_target_properties(${PROJECT_NAME}__${library}
        PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
    endif()
  endforeach()
endfunction()
cmake_language(DEFER CALL compile_together)
