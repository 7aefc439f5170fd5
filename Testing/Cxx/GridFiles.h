/**
 * What the tests of .vdb files are written with: an ear for what a reader or writer says, and small
 * files.
 */
#ifndef GridFiles_h
#define GridFiles_h

#include "vtkActiveVDBReader.h"
#include "vtkActiveVDBWriter.h"
#include "vtkCallbackCommand.h"
#include "vtkExecutive.h"
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

/** The errors of an algorithm and its executive, in place of the output window. */
class ErrorsOf
{
public:
  explicit ErrorsOf(vtkAlgorithm* algorithm)
  {
    vtkNew<vtkCallbackCommand> note;
    note->SetClientData(this);
    note->SetCallback(
      [](vtkObject* object, unsigned long, void* self, void* text)
      {
        auto errors = static_cast<ErrorsOf*>(self);
        if (!object->IsA("vtkExecutive"))
        {
          errors->Said.emplace_back(static_cast<const char*>(text));
        }
      });
    algorithm->AddObserver(vtkCommand::ErrorEvent, note);
    algorithm->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, note);
  }

  std::vector<std::string> Said;

  std::string Last() const { return this->Said.empty() ? "" : this->Said.back(); }
  bool Has(const std::string& words) const { return this->Last().find(words) != std::string::npos; }
};

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
