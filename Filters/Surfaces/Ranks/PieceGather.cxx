#include "Ranks/PieceGather.h"

#include "Base/OpenVDB.h"
#include "Input/AttachedData.h"
#include "Input/AttachedGrid.h"
#include "Ranks/Communicator.h"
#include "Ranks/InputPiece.h"
#include "Ranks/WholeOfPieces.h"

#include "vtkDataSet.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkXMLImageDataReader.h"
#include "vtkXMLImageDataWriter.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <openvdb/io/Stream.h>
#include <sstream>
#include <stdexcept>
#include <string>

namespace activesurface
{

namespace
{

// Serializes a data set. Lossless: numbers keep their types and all bits.
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
    throw std::runtime_error("A piece of the input cannot be sent to the other ranks, because "
                             "VTK's XML writer failed; see the error of the writer.");
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
    throw std::runtime_error("A piece of the input from another rank cannot be read by VTK's XML "
                             "reader; use the same version of VTK on all ranks.");
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

// Layout: kind (1 byte), length of the data (8 bytes), data, grid. Throws std::runtime_error if a
// piece cannot be written.
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

// Returns the kind of the pieces with data. Throws if two kinds differ.
PieceKind FindKind(const std::vector<PieceKind>& kinds, const std::string& what)
{
  PieceKind kind = PieceKind::Nothing;
  std::size_t first = 0;
  for (std::size_t rank = 0; rank < kinds.size(); ++rank)
  {
    if (kind == PieceKind::Nothing)
    {
      kind = kinds[rank];
      first = rank;
    }
    else if (kinds[rank] != PieceKind::Nothing && kinds[rank] != kind)
    {
      throw std::invalid_argument(what + " has different kinds of data on ranks " +
        std::to_string(first) + " and " + std::to_string(rank) +
        "; use one kind for all pieces: only particles, only polygons, only lines, only images "
        "with values, or only images with an OpenVDB grid.");
    }
  }
  return kind;
}

}

AllPieces AgreeOnPieces(const Agreement& ranks, const PieceFacts& own, const std::string& what)
{
  AllPieces all;
  std::vector<PieceKind> kinds;
  for (const PieceFacts& facts : ranks.ExchangeValue(own))
  {
    constexpr std::uint64_t factor = 0x9e3779b97f4a7c15ull;
    all.PointsBefore += static_cast<int>(kinds.size()) < ranks.GetRank() ? facts.Points : 0;
    all.Points += facts.Points;
    all.Content = (all.Content ^ facts.Content) * factor + facts.Points;
    all.HaveCells = all.HaveCells || facts.HasCells;
    kinds.push_back(facts.Kind);
  }
  all.Kind = FindKind(kinds, what);
  return all;
}

vtkSmartPointer<vtkDataSet> GatherWhole(
  Agreement& ranks, const InputPiece& own, const std::string& what)
{
  std::vector<InputPiece> pieces;
  for (const Bytes& bytes : ranks.Exchange(PackPiece(own)))
  {
    pieces.push_back(UnpackPiece(bytes));
  }
  std::vector<vtkDataSet*> parts;
  std::vector<PieceKind> kinds;
  for (const InputPiece& piece : pieces)
  {
    parts.push_back(piece.Data);
    kinds.push_back(piece.Kind);
  }
  switch (FindKind(kinds, what))
  {
    case PieceKind::Particles:
    case PieceKind::Cells:
      return AppendPieces(parts, what);
    case PieceKind::Image:
      return AssembleImage(parts, what);
    case PieceKind::GridImage:
    {
      vtkSmartPointer<vtkDataSet> whole = AssembleImage(parts, what);
      const auto first =
        std::find_if(parts.begin(), parts.end(), [](vtkDataSet* part) { return part; });
      CopyAttachedGrid((*first)->GetInformation(), whole->GetInformation());
      return whole;
    }
    default:
      return vtkSmartPointer<vtkPolyData>::New();
  }
}

}
