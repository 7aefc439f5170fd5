// Series of .vdb files, one for each time step: their times, and the file that was validated last.

#ifndef VDBSeries_h
#define VDBSeries_h

#include "VDBFile.h"

#include <cstdint>
#include <string>
#include <vector>

namespace activesurface
{

class VDBSeries
{
public:
  // Changes when the reader changes; files are then validated again.
  using Version = std::uint64_t;

  // Opens a file and chooses its grids by name. Throws std::exception if the file cannot be read.
  void Open(const std::vector<std::string>& files, const std::vector<std::string>& gridNames,
    int number, Version version);
  void Close();

  // Reads the times from the files' metadata. Times that do not ascend are replaced by file
  // indices.
  void FindTimes(const std::vector<std::string>& files, Version version);
  const std::vector<double>& GetTimes() const { return this->Times; }
  // Index of the file for a time.
  int FindFile(double time) const;

  const VDBFile& GetFile() const { return this->File; }
  int GetFileNumber() const { return this->FileNumber; }
  const std::string& GetFileName() const { return this->FileName; }
  const std::vector<VDBGrid>& GetChosen() const { return this->Chosen; }
  // Returns null if there is no such grid.
  const VDBGrid* FindGrid(int i) const;

  bool IsOfPoints() const;
  // Bounding box of the chosen grids' active voxels.
  openvdb::CoordBBox FindActiveBox() const;

private:
  Version TimesVersion = 0;
  std::vector<double> Times;

  Version FileVersion = 0;
  int FileNumber = -1;
  std::string FileName;
  VDBFile File;
  std::vector<VDBGrid> Chosen;
};

}

#endif
