#include "Ranks/PieceBytes.h"

#include "Ranks/InputPiece.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkXMLImageDataReader.h"
#include "vtkXMLImageDataWriter.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

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

}

Bytes PackPiece(const InputPiece& piece)
{
  Bytes bytes(1, static_cast<char>(piece.Kind));
  if (piece.Kind != PieceKind::Nothing)
  {
    const std::string text = IsImage(piece.Kind) ? Write<vtkXMLImageDataWriter>(piece.Data)
                                                 : Write<vtkXMLPolyDataWriter>(piece.Data);
    bytes.insert(bytes.end(), text.begin(), text.end());
  }
  return bytes;
}

InputPiece UnpackPiece(const Bytes& bytes)
{
  InputPiece piece;
  piece.Kind = static_cast<PieceKind>(bytes.at(0));
  if (piece.Kind != PieceKind::Nothing)
  {
    const char* first = bytes.data() + 1;
    const std::size_t length = bytes.size() - 1;
    piece.Data = IsImage(piece.Kind) ? Read<vtkXMLImageDataReader>(first, length)
                                     : Read<vtkXMLPolyDataReader>(first, length);
  }
  return piece;
}

}
