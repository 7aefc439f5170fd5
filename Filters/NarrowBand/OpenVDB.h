/**
 * OpenVDB, with its templates visible beyond this library, as everything else here is not.
 *
 * OpenVDB's grids keep static members and flags of "called once" in templates. Each program must
 * have one of each: were the members hidden and the flags not, the first library to call would fill
 * its own members alone, and the others would read null. So OpenVDB is included by this header, and
 * before any other header of OpenVDB.
 */
#ifndef OpenVDB_h
#define OpenVDB_h

#pragma GCC visibility push(default)
#include <openvdb/openvdb.h>
#pragma GCC visibility pop

/** Calls X with the name of each type of tree whose grids sources here make; all are among those
 * that OpenVDB's library registers. */
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

// The functions of a grid take ten seconds to compile. OpenVDB's library has those that are
// virtual, compiled for the types that it registers; the others are inlined or stand in
// OpenVDB.cxx. Where too few are inlined, ACTIVE_COMPILE_GRIDS compiles them all.
#define OpenVDB_Declare(Name)                                                                      \
  extern template class openvdb::tree::Tree<openvdb::Name::RootNodeType>;                          \
  extern template class openvdb::Grid<openvdb::Name>;
OpenVDB_ForEachTree(OpenVDB_Declare)
#undef OpenVDB_Declare

#endif
