// What a vtkActiveVDBReader knows of its files.

#ifndef VDBReaderState_h
#define VDBReaderState_h

#include "VDBFile.h"
#include "vtkActiveVDBReader.h"

#include "vtkNew.h"
#include "vtkStringArray.h"

#include <string>
#include <vector>

// As of a change of the reader.
struct vtkActiveVDBReader::Internals
{
  vtkMTimeType TimesOf = 0;
  std::vector<double> Times; // of a series

  vtkMTimeType LookedAt = 0;
  int FileNumber = -1;
  activesurface::VDBFile File;
  std::vector<activesurface::VDBGrid> Chosen;
  vtkNew<vtkStringArray> Names; // of all grids, for who asks for a list

  const activesurface::VDBGrid* Find(int i) const
  {
    return i >= 0 && i < static_cast<int>(this->File.Grids.size()) ? &this->File.Grids[i] : nullptr;
  }
  openvdb::CoordBBox FindBox(const vtkActiveVDBReader* reader) const;
  bool IsOfPoints() const
  {
    return !this->Chosen.empty() && std::string(this->Chosen.front().GetValueType()) == "points";
  }
};

#endif
