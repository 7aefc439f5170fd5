// The .vdb files of a reader, one for each time step: their times, and what is known of the one
// that was validated last.

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
  // Changes when the reader does: then files are validated anew.
  using Version = std::uint64_t;

  // The file's grids, and those of them that the names choose. Throws std::exception if the file
  // cannot be read.
  void Open(const std::vector<std::string>& files, const std::vector<std::string>& gridNames,
    int number, Version version);
  void Close();

  // The times in the files' metadata where they ascend, else their numbers.
  void FindTimes(const std::vector<std::string>& files, Version version);
  const std::vector<double>& GetTimes() const { return this->Times; }
  // The number of the file for a time.
  int FindFile(double time) const;

  const VDBFile& GetFile() const { return this->File; }
  int GetFileNumber() const { return this->FileNumber; }
  const std::string& GetFileName() const { return this->FileName; }
  const std::vector<VDBGrid>& GetChosen() const { return this->Chosen; }
  // Null if there is none.
  const VDBGrid* FindGrid(int i) const;

  bool IsOfPoints() const;
  // Box of the chosen grids' active voxels.
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
