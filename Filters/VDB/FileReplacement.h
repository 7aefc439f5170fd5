// A file that is either written whole or not there: it is written under a temporary name beside it,
// which becomes its own when all is well.
//
//   FileReplacement file("a.vdb");
//   write to file.GetTemporaryName(), throw if that fails
//   file.Finish();

#ifndef FileReplacement_h
#define FileReplacement_h

#include "ActiveVDBExport.h"

#include <string>

namespace activesurface
{

class ACTIVEVDB_EXPORT FileReplacement
{
public:
  // Throws std::runtime_error if a folder or a device bears the name.
  explicit FileReplacement(const std::string& name);

  // Unless Finish was called, removes what was written; a file that was there before stays.
  ~FileReplacement();

  const std::string& GetTemporaryName() const { return this->TemporaryName; }

  // Throws std::runtime_error, saying why, if it cannot get its name.
  void Finish();

private:
  FileReplacement(const FileReplacement&) = delete;
  void operator=(const FileReplacement&) = delete;

  std::string Name;
  std::string TemporaryName;
  bool Finished = false;
};

}

#endif
