# The target `documentation_python` makes pages from the package's docstrings by Sphinx with
# numpydoc, in <build folder>/documentation/python. The target `documentation` includes this target.

execute_process(COMMAND "${Python3_EXECUTABLE}" -c "import sphinx, numpydoc"
  RESULT_VARIABLE sphinx_is_missing OUTPUT_QUIET ERROR_QUIET)
if (sphinx_is_missing OR SKBUILD)
  return()
endif ()

# Sphinx runs on a copy, because conf.py writes pages to its own folder.
set(pages "${CMAKE_BINARY_DIR}/documentation/python-pages")
add_custom_target(documentation_python
  COMMAND "${CMAKE_COMMAND}" -E rm -rf "${pages}"
  COMMAND "${CMAKE_COMMAND}" -E copy_directory "${CMAKE_CURRENT_SOURCE_DIR}/documentation" "${pages}"
  COMMAND "${CMAKE_COMMAND}" -E env
    "PYTHONPATH=${CMAKE_BINARY_DIR}/${ACTIVE_PYTHON_DESTINATION}" PYTHONDONTWRITEBYTECODE=1
    "${Python3_EXECUTABLE}" -m sphinx -q -n -E -W --keep-going
    "${pages}" "${CMAKE_BINARY_DIR}/documentation/python"
  DEPENDS ActiveImplicitSurfacesPython
  COMMENT "Python's pages in build folder/documentation/python")
if (NOT TARGET documentation)
  add_custom_target(documentation)
endif ()
add_dependencies(documentation documentation_python)
