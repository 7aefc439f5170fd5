/**
 * OpenVDB, with templates that are visible to other libraries. Other symbols of this library are
 * hidden unless marked ACTIVELEVELSET_EXPORT.
 *
 * OpenVDB's grids keep static members, and the std::once_flag of each, in templates. A program must
 * have one copy of every member and flag. If members were hidden but flags were not, the first
 * library to call would fill only its own members, and other libraries would read null. Include
 * this header before any other header of OpenVDB.
 */
#ifndef OpenVDB_h
#define OpenVDB_h

#pragma GCC visibility push(default)
#include <openvdb/openvdb.h>
#pragma GCC visibility pop

/** Calls X with the name of each tree type of the grids that this project creates. OpenVDB's
 * library registers all these types. */
#define OpenVDB_ForEachTree(X)                                                                     \
  X(BoolTree)                                                                                      \
  X(MaskTree)                                                                                      \
  X(FloatTree)                                                                                     \
  X(DoubleTree)                                                                                    \
  X(Int32Tree)                                                                                     \
  X(Int64Tree)                                                                                     \
  X(Vec3STree)                                                                                     \
  X(Vec3DTree)                                                                                     \
  X(Vec3ITree)

// The functions of a grid need ten seconds to compile. OpenVDB's library has the virtual functions,
// compiled for the types that it registers. Other functions are inlined or are in OpenVDB.cxx. For
// a compiler that inlines too few functions, the CMake option ACTIVE_COMPILE_GRIDS compiles all.
#define OpenVDB_Declare(Name)                                                                      \
  extern template class openvdb::tree::Tree<openvdb::Name::RootNodeType>;                          \
  extern template class openvdb::Grid<openvdb::Name>;
OpenVDB_ForEachTree(OpenVDB_Declare)
#undef OpenVDB_Declare

#endif
