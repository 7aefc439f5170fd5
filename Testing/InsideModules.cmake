# The modules with all their symbols: tests and benchmarks use symbols that the libraries hide. They
# link these targets and never the libraries, whose symbols would be second copies.
#
# active_add_inside(<module> <target>...): adds Inside<module>, linked to the other targets.
function (active_add_inside module)
  if (TARGET Inside${module})
    return()
  endif ()
  add_library(Inside${module} STATIC $<TARGET_OBJECTS:ActiveImplicitSurfaces::Active${module}>)
  set_target_properties(Inside${module} PROPERTIES LINKER_LANGUAGE CXX)
  target_include_directories(Inside${module} INTERFACE
    "${PROJECT_SOURCE_DIR}/Filters/${module}" "${PROJECT_BINARY_DIR}/Filters/${module}")
  target_link_libraries(Inside${module} INTERFACE ${ARGN})
endfunction ()

active_add_inside(LevelSet OpenVDB::openvdb TBB::tbb VTK::CommonCore)
active_add_inside(Files InsideLevelSet VTK::CommonCore VTK::CommonDataModel)
active_add_inside(Particles InsideFiles VTK::CommonExecutionModel)
active_add_inside(Shapes InsideParticles)
active_add_inside(Surfaces InsideShapes VTK::CommonMath VTK::IOXML VTK::ParallelCore)
active_add_inside(IO InsideShapes VTK::CommonMath VTK::IOImage VTK::ParallelCore
  OpenEXR::OpenEXR)

# These targets include OpenVDB themselves, whose templates have to be visible (see OpenVDB.h).
set(CMAKE_CXX_VISIBILITY_PRESET default)
set(CMAKE_VISIBILITY_INLINES_HIDDEN OFF)
