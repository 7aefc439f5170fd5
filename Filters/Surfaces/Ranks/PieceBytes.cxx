#include "Ranks/PieceBytes.h"

#include "Base/OpenVDB.h"
#include "Input/AttachedGrid.h"
#include "Ranks/InputPiece.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkXMLImageDataReader.h"
#include "vtkXMLImageDataWriter.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#include <openvdb/io/Stream.h>

#include <cstdint>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <string>

namespace activesurface
{

namespace
{

template <class Writer>
std::string Write(vtkDataSet* data)
{
  vtkNew<Writer> writer;
  writer->SetInputData(data);
  writer->WriteToOutputStringOn();
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToNone();
  writer->SetHeaderTypeToUInt64();
  if (!writer->Write())
  {
    throw std::runtime_error("A piece of the input cannot be sent to the other ranks.");
  }
  return writer->GetOutputString();
}

template <class Reader>
vtkSmartPointer<vtkDataSet> Read(const char* first, std::size_t length)
{
  vtkNew<Reader> reader;
  reader->ReadFromInputStringOn();
  reader->SetInputString(std::string(first, length));
  reader->Update();
  if (reader->GetErrorCode() != 0)
  {
    throw std::runtime_error("A piece of the input has come from another rank damaged.");
  }
  return reader->GetOutputAsDataSet();
}

bool IsImage(PieceKind kind)
{
  return kind == PieceKind::Image || kind == PieceKind::GridImage;
}

// Returns the attached grid as bytes; empty if there is none.
std::string WriteGrid(vtkDataSet* data)
{
  const openvdb::FloatGrid::ConstPtr grid = GetAttachedGrid(data->GetInformation());
  if (!grid)
  {
    return "";
  }
  openvdb::initialize();
  std::ostringstream text(std::ios::binary);
  openvdb::io::Stream(text).write(openvdb::GridCPtrVec{ grid });
  return text.str();
}

void ReadGrid(const std::string& text, vtkDataSet* data)
{
  openvdb::initialize();
  std::istringstream stream(text, std::ios::binary);
  const openvdb::GridPtrVecPtr grids = openvdb::io::Stream(stream).getGrids();
  Attach(data->GetInformation(), openvdb::gridPtrCast<openvdb::FloatGrid>(grids->at(0)));
}

}

// Layout: kind (1 byte), length of the data (8 bytes), data, grid.
Bytes PackPiece(const InputPiece& piece)
{
  Bytes bytes(1, static_cast<char>(piece.Kind));
  if (piece.Kind == PieceKind::Nothing)
  {
    return bytes;
  }
  const std::string data = IsImage(piece.Kind) ? Write<vtkXMLImageDataWriter>(piece.Data)
                                               : Write<vtkXMLPolyDataWriter>(piece.Data);
  const std::string grid = WriteGrid(piece.Data);
  const std::uint64_t length = data.size();
  const char* first = reinterpret_cast<const char*>(&length);
  bytes.insert(bytes.end(), first, first + sizeof length);
  bytes.insert(bytes.end(), data.begin(), data.end());
  bytes.insert(bytes.end(), grid.begin(), grid.end());
  return bytes;
}

InputPiece UnpackPiece(const Bytes& bytes)
{
  InputPiece piece;
  piece.Kind = static_cast<PieceKind>(bytes.at(0));
  if (piece.Kind != PieceKind::Nothing)
  {
    std::uint64_t length = 0;
    std::memcpy(&length, bytes.data() + 1, sizeof length);
    const char* first = bytes.data() + 1 + sizeof length;
    piece.Data = IsImage(piece.Kind) ? Read<vtkXMLImageDataReader>(first, length)
                                     : Read<vtkXMLPolyDataReader>(first, length);
    if (piece.Kind == PieceKind::GridImage)
    {
      ReadGrid({ first + length, bytes.data() + bytes.size() }, piece.Data);
    }
  }
  return piece;
}

}
