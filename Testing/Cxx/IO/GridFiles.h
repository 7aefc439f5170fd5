/**
 * Files and grids for the tests of .vdb files.
 */
#ifndef GridFiles_h
#define GridFiles_h

#include "vtkActiveVDBReader.h"
#include "vtkActiveVDBWriter.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace activesurface
{

inline std::string ReadFile(const std::string& name)
{
  std::ifstream file(name, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return bytes.str();
}

template <class Grid = openvdb::FloatGrid>
typename Grid::Ptr Load(const std::string& file, const std::string& name)
{
  openvdb::initialize();
  openvdb::io::File in(file);
  in.open();
  return openvdb::gridPtrCast<Grid>(in.readGrid(name));
}

inline void Save(const std::string& file, const openvdb::GridPtrVec& grids)
{
  openvdb::initialize();
  openvdb::io::File out(file);
  out.write(grids);
}

}

#endif
