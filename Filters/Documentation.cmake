# The target `documentation`: API pages in <build folder>/documentation/html (Python's:
# Python/Documentation.cmake). The documentation of a class is in its header. Headers in sub-folders
# of a module are left out.

set(DOXYGEN_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/documentation")
set(DOXYGEN_STRIP_FROM_PATH "${PROJECT_SOURCE_DIR}")
set(DOXYGEN_FILE_PATTERNS "*.h")
set(DOXYGEN_RECURSIVE NO)
set(DOXYGEN_EXTRACT_ALL YES)
set(DOXYGEN_JAVADOC_AUTOBRIEF YES)
set(DOXYGEN_DISTRIBUTE_GROUP_DOC YES)
set(DOXYGEN_GENERATE_LATEX NO)
set(DOXYGEN_HAVE_DOT NO)
set(DOXYGEN_QUIET YES)
set(DOXYGEN_WARN_AS_ERROR FAIL_ON_WARNINGS)

# VTK's macros declare the functions of a property.
set(DOXYGEN_MACRO_EXPANSION YES)
set(DOXYGEN_EXPAND_ONLY_PREDEF YES)
set(DOXYGEN_PREDEFINED
  "vtkSetMacro(name,type)=virtual void Set##name(type)\;"
  "vtkGetMacro(name,type)=virtual type Get##name()\;"
  "vtkSetClampMacro(name,type,low,high)=virtual void Set##name(type)\;"
  "vtkBooleanMacro(name,type)=virtual void name##On()\; virtual void name##Off()\;"
  "vtkSetVector6Macro(name,type)=virtual void Set##name(type, type, type, type, type, type)\;"
  "vtkGetVector6Macro(name,type)=virtual type* Get##name()\;"
  "vtkSetVector2Macro(name,type)=virtual void Set##name(type, type)\;"
  "vtkGetVector2Macro(name,type)=virtual type* Get##name()\;"
  "vtkSetStringMacro(name)=virtual void Set##name(const char*)\;"
  "vtkGetStringMacro(name)=virtual char* Get##name()\;"
  "vtkTypeMacro(type,base)=using Superclass = base\;"
  "vtkAbstractTypeMacro(type,base)=using Superclass = base\;"
  "VTKACTIVEIO_EXPORT="
  "ACTIVELEVELSET_EXPORT="
  "VTKACTIVEPARTICLES_EXPORT="
  "VTKACTIVESHAPES_EXPORT="
  "VTKACTIVESURFACES_EXPORT="
  "ACTIVEFILES_EXPORT="
  "ACTIVE_ALWAYS_INLINE="
  "ACTIVE_INLINED=")

doxygen_add_docs(documentation LevelSet Files Particles Shapes Surfaces IO
  COMMENT "API pages in build folder/documentation/html")
