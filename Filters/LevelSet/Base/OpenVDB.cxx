#include "Base/OpenVDB.h"

// Functions of grids that are neither virtual nor short enough to be inlined everywhere.
#define OpenVDB_Define(Name)                                                                       \
  template openvdb::Grid<openvdb::Name>::Ptr openvdb::Grid<openvdb::Name>::create(                 \
    openvdb::Name::Ptr);
OpenVDB_ForEachTree(OpenVDB_Define)
