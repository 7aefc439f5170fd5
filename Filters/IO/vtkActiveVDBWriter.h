/**
 * @class   vtkActiveVDBWriter
 * @brief   writes a living skin, a closed mesh or an image as narrow-band .vdb files
 *
 * Input: output port 0 or 1 of a vtkActiveImplicitSurface, whose own grid then is written, without
 * a detour through a dense image; any closed vtkPolyData; or any vtkImageData.
 *
 * Of a surface the file has the grid "surface", a level set: the true distance to the skin's
 * triangles [length], negative inside, within 3 voxels on either side and +-3 voxels beyond. Its
 * transform is exact: voxels of the skin's VoxelSize, with nodes at multiples of it. Besides, as
 * the properties below say, the state to go on from, a fog, the velocity and the point arrays. A
 * mesh that does not come from a vtkActiveImplicitSurface has to be closed (each edge belongs to an
 * even number of polygons; its points have to exist and be finite), and is converted by OpenVDB's
 * own meshToVolume with voxels of VoxelSize.
 *
 * Of an image the file has a grid for its active scalars (else its first point array), named after
 * the array or "density", with active values where they are not 0; see GridClass.
 *
 * All grids, and the file, have the metadata creator, time [pipeline time], frame (number of the
 * time step), units, and motion_X for each property X of the filter that shapes its motion.
 *
 * A file is written under another name first, read through, and then gets its own, so it is there
 * as a whole or not at all. What cannot be done is an error with a sentence, and ErrorCode.
 */

#ifndef vtkActiveVDBWriter_h
#define vtkActiveVDBWriter_h

#include "vtkActiveIOModule.h" // for the export macro
#include "vtkAlgorithm.h"
#include "vtkSmartPointer.h" // for the controller

#include <string> // for names

class vtkDataObject;
class vtkMultiProcessController;

class VTKACTIVEIO_EXPORT vtkActiveVDBWriter : public vtkAlgorithm
{
public:
  static vtkActiveVDBWriter* New();
  vtkTypeMacro(vtkActiveVDBWriter, vtkAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Name of the file, or of the series: the last run of # in it stands for the number of the time
   * step, with so many digits at least; without one, WriteAllTimeSteps puts a number of four digits
   * before the extension, name.0007.vdb. Default: none, which is an error.
   */
  void SetFileName(const char* name);
  const char* GetFileName() const { return this->FileName.c_str(); }
  ///@}

  ///@{
  /**
   * Data to write, instead of an input connection. Default: none.
   */
  void SetInputData(vtkDataObject* data) { this->SetInputDataObject(0, data); }
  ///@}

  ///@{
  /**
   * Whether Write() writes a file for each time step of the input, in place of one for the time
   * that the input was last updated for. Default: off.
   */
  vtkSetMacro(WriteAllTimeSteps, vtkTypeBool);
  vtkGetMacro(WriteAllTimeSteps, vtkTypeBool);
  vtkBooleanMacro(WriteAllTimeSteps, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether the file also has the grid "potential", the state without loss, which the filter's
   * LoadState takes up again to the same bytes. Only of a vtkActiveImplicitSurface, and at one of
   * its time steps: between two there is none. It is never written as
   * half floats. Default: off.
   */
  vtkSetMacro(WriteState, vtkTypeBool);
  vtkGetMacro(WriteState, vtkTypeBool);
  vtkBooleanMacro(WriteState, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether the file also has the grid "density", a fog: 1 inside, and from 3 voxels within the
   * surface on falling to 0 at it. Of surfaces only. Default: off.
   */
  vtkSetMacro(WriteDensity, vtkTypeBool);
  vtkGetMacro(WriteDensity, vtkTypeBool);
  vtkBooleanMacro(WriteDensity, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether the file also has the grid "v", the velocity [length/time] near the surface, for motion
   * blur: of the skin's point array "Velocity" (the filter's ComputeVelocity), which has to be
   * there. Default: off.
   */
  vtkSetMacro(WriteVelocity, vtkTypeBool);
  vtkGetMacro(WriteVelocity, vtkTypeBool);
  vtkBooleanMacro(WriteVelocity, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether each point array of one or three components becomes a grid of its own name: of a
   * surface near by, as it is at the nearest point of the skin (whole numbers are taken from the
   * nearest corner); of an image all of them. Other arrays are an error. Default: off.
   */
  vtkSetMacro(WritePointArrays, vtkTypeBool);
  vtkGetMacro(WritePointArrays, vtkTypeBool);
  vtkBooleanMacro(WritePointArrays, vtkTypeBool);
  ///@}

  enum GridClasses
  {
    UNKNOWN = 0,
    LEVEL_SET = 1,
    FOG_VOLUME = 2
  };

  ///@{
  /**
   * What the scalars of an image are: anything (UNKNOWN (0)), a distance [length] that becomes a
   * narrow band of 3 voxels of single precision (LEVEL_SET (1)), or a density (FOG_VOLUME (2)).
   * Default: UNKNOWN.
   */
  vtkSetClampMacro(GridClass, int, UNKNOWN, FOG_VOLUME);
  vtkGetMacro(GridClass, int);
  void SetGridClassToUnknown() { this->SetGridClass(UNKNOWN); }
  void SetGridClassToLevelSet() { this->SetGridClass(LEVEL_SET); }
  void SetGridClassToFogVolume() { this->SetGridClass(FOG_VOLUME); }
  ///@}

  ///@{
  /**
   * Size of the voxels [length] for a mesh that does not come from a vtkActiveImplicitSurface.
   * Range: >= 0. Default: 0, the longest side of the mesh's bounds / 64.
   */
  vtkSetClampMacro(VoxelSize, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(VoxelSize, double);
  ///@}

  ///@{
  /**
   * Whether numbers are written as half floats, of three digits, but for the state. Default: off.
   */
  vtkSetMacro(HalfFloat, vtkTypeBool);
  vtkGetMacro(HalfFloat, vtkTypeBool);
  vtkBooleanMacro(HalfFloat, vtkTypeBool);
  ///@}

  enum Compressions
  {
    NONE = 0,
    ACTIVE_MASK = 1,
    ZIP = 2,
    BLOSC = 3
  };

  ///@{
  /**
   * How values are packed, without loss: not at all (NONE (0)), active ones alone where that is
   * enough (ACTIVE_MASK (1)), those by zlib (ZIP (2), slow; OpenVDB then leaves level sets and fogs
   * as they are) or by Blosc (BLOSC (3), quick). Default: BLOSC.
   */
  vtkSetClampMacro(Compression, int, NONE, BLOSC);
  vtkGetMacro(Compression, int);
  void SetCompressionToNone() { this->SetCompression(NONE); }
  void SetCompressionToActiveMask() { this->SetCompression(ACTIVE_MASK); }
  void SetCompressionToZip() { this->SetCompression(ZIP); }
  void SetCompressionToBlosc() { this->SetCompression(BLOSC); }
  ///@}

  ///@{
  /**
   * The unit of length, in free words, for the metadata "units". Default: none.
   */
  void SetUnits(const char* units);
  const char* GetUnits() const { return this->Units.c_str(); }
  ///@}

  ///@{
  /**
   * The ranks of a parallel program, which call Write together: all update the input, the first one
   * writes what it has; that is all of it, from a vtkActiveImplicitSurface on these ranks. None, or
   * one of a single process: this process writes. Default: VTK's global controller.
   */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController();
  ///@}

  /**
   * Updates the input and writes. 0, with an error and ErrorCode, if that fails or AbortExecute was
   * set; the files of earlier time steps then are there.
   */
  int Write();

protected:
  vtkActiveVDBWriter();
  ~vtkActiveVDBWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;

private:
  vtkActiveVDBWriter(const vtkActiveVDBWriter&) = delete;
  void operator=(const vtkActiveVDBWriter&) = delete;

  void WriteSteps();
  void WriteData(const std::string& file, vtkDataObject* data, int frame);

  std::string FileName;
  std::string Units;
  vtkTypeBool WriteAllTimeSteps = 0;
  vtkTypeBool WriteState = 0;
  vtkTypeBool WriteDensity = 0;
  vtkTypeBool WriteVelocity = 0;
  vtkTypeBool WritePointArrays = 0;
  int GridClass = UNKNOWN;
  double VoxelSize = 0.0;
  vtkTypeBool HalfFloat = 0;
  int Compression = BLOSC;
  vtkSmartPointer<vtkMultiProcessController> Controller;
};

#endif
