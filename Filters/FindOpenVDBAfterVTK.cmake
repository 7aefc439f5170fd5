# Finds OpenVDB, for the build and for those who use the installed package alike. OpenVDB ships no
# package config, only a find module, in a folder that CMake does not search. Include this file
# after find_package(VTK): VTK and OpenVDB look for TBB, and in the other order find_package(VTK)
# fails.
find_path(ActiveImplicitSurfaces_OPENVDB_MODULES FindOpenVDB.cmake
  PATHS
    "/usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB"
    /usr/lib/cmake/OpenVDB
    /usr/local/lib/cmake/OpenVDB
  PATH_SUFFIXES
    "lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB"
    lib/cmake/OpenVDB
  DOC "Folder of FindOpenVDB.cmake, which OpenVDB installs.")
mark_as_advanced(ActiveImplicitSurfaces_OPENVDB_MODULES)

if (NOT ActiveImplicitSurfaces_OPENVDB_MODULES)
  message(FATAL_ERROR
    "FindOpenVDB.cmake was not found: install OpenVDB's development files (Debian: "
    "libopenvdb-dev) or set ActiveImplicitSurfaces_OPENVDB_MODULES to the folder that holds it.")
endif ()

set(active_module_path "${CMAKE_MODULE_PATH}")
list(APPEND CMAKE_MODULE_PATH "${ActiveImplicitSurfaces_OPENVDB_MODULES}")
find_package(OpenVDB REQUIRED)
set(CMAKE_MODULE_PATH "${active_module_path}")
unset(active_module_path)
