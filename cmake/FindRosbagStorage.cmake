# Rosbag::storage: ROS 1's own reader and writer of bags (Debian: librosbag-storage-dev). Its package files for CMake
# and pkg-config are not used: the first needs ament and ament's Python modules, the second names a package that does
# not exist.
find_path(RosbagStorage_INCLUDE_DIR rosbag/bag.h)
set(RosbagStorage_INCLUDE_DIRS ${RosbagStorage_INCLUDE_DIR})
set(RosbagStorage_PARTS RosbagStorage_INCLUDE_DIR)
# Each package whose headers bag.h includes has its own folder.
foreach(header pluginlib/class_loader.hpp class_loader/class_loader.hpp rcpputils/shared_library.hpp
    rcutils/types.h ament_index_cpp/get_package_prefix.hpp)
  string(REGEX REPLACE "/.*" "" package ${header})
  find_path(RosbagStorage_${package}_DIR ${header} PATH_SUFFIXES ${package})
  list(APPEND RosbagStorage_INCLUDE_DIRS ${RosbagStorage_${package}_DIR})
  list(APPEND RosbagStorage_PARTS RosbagStorage_${package}_DIR)
endforeach()
foreach(library rosbag_storage roscpp_serialization rostime cpp_common console_bridge)
  find_library(RosbagStorage_${library}_LIBRARY ${library})
  list(APPEND RosbagStorage_LIBRARIES ${RosbagStorage_${library}_LIBRARY})
  list(APPEND RosbagStorage_PARTS RosbagStorage_${library}_LIBRARY)
endforeach()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(RosbagStorage REQUIRED_VARS ${RosbagStorage_PARTS})
mark_as_advanced(${RosbagStorage_PARTS})
if(RosbagStorage_FOUND AND NOT TARGET Rosbag::storage)
  add_library(Rosbag::storage INTERFACE IMPORTED GLOBAL)
  list(REMOVE_DUPLICATES RosbagStorage_INCLUDE_DIRS)
  target_include_directories(Rosbag::storage INTERFACE ${RosbagStorage_INCLUDE_DIRS})
  target_link_libraries(Rosbag::storage INTERFACE ${RosbagStorage_LIBRARIES})
endif()
