# The libraries without VTK: LevelSet and Files. VTK's and ParaView's builds can use the same
# libraries: with ACTIVE_NUMERICS a build uses those of another build folder, and builds them there.
include(GenerateExportHeader)

set(ACTIVE_NUMERICS "" CACHE PATH
  "Build folder of this project whose libraries without VTK are used; empty: they are built here.")

# active_add_numerics(<name> [CLASSES <class>...] [HEADERS <header>...] [HEADERS_SUBDIR <folder>]
#   PRIVATE_CLASSES <class>... [SOURCES <source>...])
#
# One library of pairs of .h and .cxx. Classes and headers are installed, private classes are not.
function (active_add_numerics name)
  cmake_parse_arguments(PARSE_ARGV 1 library "" "HEADERS_SUBDIR" "CLASSES;HEADERS;PRIVATE_CLASSES;SOURCES")
  list(TRANSFORM library_CLASSES APPEND .h OUTPUT_VARIABLE headers)
  list(APPEND headers ${library_HEADERS})
  list(TRANSFORM library_CLASSES APPEND .cxx OUTPUT_VARIABLE sources)
  list(TRANSFORM library_PRIVATE_CLASSES APPEND .cxx)

  add_library(${name} SHARED ${sources} ${library_PRIVATE_CLASSES} ${library_SOURCES})
  add_library(ActiveImplicitSurfaces::${name} ALIAS ${name})
  set_target_properties(${name} PROPERTIES
    OUTPUT_NAME vtk${name}
    ${ACTIVE_VERSIONS}
    ${ACTIVE_UNITY})
  generate_export_header(${name} EXPORT_FILE_NAME ${name}Export.h)
  target_compile_features(${name} PUBLIC cxx_std_17)
  target_compile_options(${name} PRIVATE ${ACTIVE_COMPILE_OPTIONS})
  target_link_options(${name} PRIVATE ${ACTIVE_LINK_OPTIONS})
  set(installed "${ACTIVE_HEADERS_DESTINATION}/${library_HEADERS_SUBDIR}")
  target_include_directories(${name} PUBLIC
    "$<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR};${CMAKE_CURRENT_BINARY_DIR}>"
    "$<INSTALL_INTERFACE:${ACTIVE_HEADERS_DESTINATION};${installed}>")

  install(TARGETS ${name}
    EXPORT ActiveNumerics
    COMPONENT numerics
    LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}")
  if (headers)
    install(FILES "${CMAKE_CURRENT_BINARY_DIR}/${name}Export.h"
      DESTINATION "${installed}"
      COMPONENT numerics)
  endif ()
  foreach (header IN LISTS headers)
    get_filename_component(room "${header}" DIRECTORY)
    install(FILES "${header}"
      DESTINATION "${installed}/${room}"
      COMPONENT numerics)
  endforeach ()
endfunction ()

if (NOT ACTIVE_NUMERICS)
  add_subdirectory(LevelSet)
  add_subdirectory(Files)
  export(EXPORT ActiveNumerics
    NAMESPACE ActiveImplicitSurfaces::
    FILE "${PROJECT_BINARY_DIR}/ActiveNumerics.cmake")
  install(EXPORT ActiveNumerics
    NAMESPACE ActiveImplicitSurfaces::
    DESTINATION "${ACTIVE_CONFIG_DESTINATION}"
    FILE ActiveNumerics.cmake
    COMPONENT numerics)
  return()
endif ()

if (NOT EXISTS "${ACTIVE_NUMERICS}/ActiveNumerics.cmake")
  message(FATAL_ERROR
    "ACTIVE_NUMERICS is ${ACTIVE_NUMERICS}, which is no configured build folder of this project. "
    "Configure the numerics in this folder first, or leave ACTIVE_NUMERICS empty.")
endif ()
include("${ACTIVE_NUMERICS}/ActiveNumerics.cmake")
# Builds the numerics first; otherwise an edit of the numerics would not reach this build.
get_target_property(level_set ActiveImplicitSurfaces::ActiveLevelSet LOCATION)
get_target_property(files ActiveImplicitSurfaces::ActiveFiles LOCATION)
add_custom_target(numerics ALL
  COMMAND "${CMAKE_COMMAND}" --build "${ACTIVE_NUMERICS}" --target ActiveLevelSet ActiveFiles
  BYPRODUCTS "${level_set}" "${files}"
  USES_TERMINAL
  COMMENT "Building the numerics in ${ACTIVE_NUMERICS}")
install(CODE "execute_process(
  COMMAND \"\${CMAKE_COMMAND}\" --install \"${ACTIVE_NUMERICS}\"
    --component numerics --prefix \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}\"
  COMMAND_ERROR_IS_FATAL ANY)")
