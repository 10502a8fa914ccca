# The CMake package: find_package(Isodiamonds), then link the target IsodiamondFilters.
include(CMakePackageConfigHelpers)
set(package_destination "${CMAKE_INSTALL_LIBDIR}/cmake/Isodiamonds")
configure_package_config_file(
  cmake/IsodiamondsConfig.cmake.in "${CMAKE_BINARY_DIR}/${package_destination}/IsodiamondsConfig.cmake"
  INSTALL_DESTINATION "${package_destination}")
write_basic_package_version_file(
  "${CMAKE_BINARY_DIR}/${package_destination}/IsodiamondsConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
configure_file(
  cmake/PythonTargets.cmake "${CMAKE_BINARY_DIR}/${package_destination}/PythonTargets.cmake" COPYONLY)
install(
  FILES
    cmake/PythonTargets.cmake
    "${CMAKE_BINARY_DIR}/${package_destination}/IsodiamondsConfig.cmake"
    "${CMAKE_BINARY_DIR}/${package_destination}/IsodiamondsConfigVersion.cmake"
  DESTINATION "${package_destination}")
