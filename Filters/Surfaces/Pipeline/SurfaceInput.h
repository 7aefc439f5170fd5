// What comes through an input port: times, shapes, and whether something upstream has changed.

#ifndef SurfaceInput_h
#define SurfaceInput_h

#include "Agreement.h"
#include "Ranks/PieceGather.h"
#include "Targets/InputData.h"
#include "Targets/InputShape.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class vtkAbstractArray;
class vtkAlgorithm;
class vtkDataObject;
class vtkDataSet;
class vtkInformation;

namespace activesurface
{

class SurfaceInput
{
public:
  enum Ports
  {
    Target = 0,
    Initial = 1
  };

  // The ranks are the caller's. Read is a round of theirs; the rest is a matter of each one.
  SurfaceInput(vtkAlgorithm* filter, Ports port, Agreement& ranks);

  // What a port takes; it may be left empty.
  static void DescribePort(int port, vtkInformation* information);
  static bool Takes(int port, vtkDataObject* data);

  bool IsConnected() const;

  // Changes whenever an algorithm or data upstream is modified, not when another time is read.
  std::uint64_t GetPipelineMTime() const;

  // Whether nothing has changed since it was such an MTime.
  bool IsStillAt(std::uint64_t time) const
  {
    return this->IsConnected() && this->GetPipelineMTime() == time;
  }

  // The time steps that the input offers; none without an input.
  static std::vector<double> GetTimeSteps(vtkInformation* information);
  // Whether the input offers any time in a range, without steps.
  static bool IsContinuous(vtkInformation* information);

  // Which arrays were chosen for radii, ids, strengths and the values of the target's and the
  // initial image; empty where none was.
  std::array<std::string, 5> DescribeArrays() const;

  // Whether the data are of blocks that the pipeline hands over one after the other, as if each
  // were the input. True before a request for data only.
  bool IsSplit(vtkInformation* information) const;

  // What to keep of particles: all their arrays, and the array of velocities, if one was chosen.
  ParticleArrays DescribeParticleArrays(bool all, bool velocities) const;

  // Reads the pieces of all ranks. areShared: of particles each rank keeps a part. Throws
  // std::invalid_argument for data that cannot be a target, and for arrays that are missing or
  // unfit.
  std::shared_ptr<InputShape> Read(vtkInformation* information,
    const ParticleArrays& kept = ParticleArrays(), bool areShared = false) const;

  // Throws as Read does, for this rank's piece alone.
  void Check(vtkDataObject* data) const;

  // All of it, or this rank's piece, at its first time step or time, if it has any.
  void RequestFirst(vtkInformation* information) const;

  // Brings the input up to date, at a time or the first one; false if it fails.
  bool Update(vtkInformation* information, double time) const;
  bool UpdateFirst(vtkInformation* information) const;

private:
  class ArraysOf;

  static std::vector<const char*> ListTypes(int port);
  bool IsArrayChosen(int index) const;
  std::string DescribeArray(int index) const;
  vtkAbstractArray* FindArray(int index, vtkDataSet* data) const;
  vtkAbstractArray* FindValues(vtkDataSet* image) const;
  struct OwnPiece
  {
    InputPiece Piece;
    std::unique_ptr<InputShape> Shape; // of the piece; null: nothing
    PieceFacts Facts;
  };
  OwnPiece MakeOwn(vtkDataSet* data, const ParticleArrays& kept) const;
  InputPiece MakePiece(vtkDataSet* data, const ParticleArrays& kept) const;
  std::shared_ptr<InputShape> ReadHome(const OwnPiece& own, const AllPieces& all,
    const ParticleArrays& kept, const std::string& name) const;
  std::unique_ptr<InputShape> ReadWhole(
    const InputPiece& piece, const ParticleArrays& kept, const std::string& name) const;
  void Request(vtkInformation* information) const;
  bool UpdateProducer() const;

  vtkAlgorithm* Filter;
  Ports Port;
  Agreement& Ranks;
};

}

#endif
