#include "OpenVDB.h"

#define OpenVDB_Define(Name)                                                                       \
  template class openvdb::tree::Tree<openvdb::Name::RootNodeType>;                                 \
  template class openvdb::Grid<openvdb::Name>;
OpenVDB_ForEachTree(OpenVDB_Define)
