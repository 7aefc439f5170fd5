/**
 * @class   vtkActiveVDBReader
 * @brief   reads .vdb files: volumes as images, points as poly data, series as time steps
 *
 * @par Output
 * - Volumes (level sets, fogs and other grids of float, half, double, int32, int64, bool, mask or
 *   vectors of three) become a vtkImageData. The chosen grids have to share one transform. Each
 *   voxel is a point of the image, and each grid is a point array. Tiles and background are
 *   expanded to voxels.
 * - Scale and translation become spacing and origin, rotations the direction matrix. Sheared
 *   volumes and perspective grids are an error.
 * - A points grid becomes a vtkPolyData with a vertex for each point and all attributes (groups as
 *   0 or 1).
 * - With OutputDense off, a level set is passed to an input port of a vtkActiveImplicitSurface, or
 *   to a vtkGridPotential, without a dense image. The output then has an extent, but no array, and
 *   carries the grid.
 * - If the ranks of a parallel program request pieces, piece 0 has all data, and other pieces are
 *   empty.
 *
 * @par Reading
 * - Only the chosen grids are read. If Region is a box, only leaves near the box are read, except
 *   in bool and mask grids, in instances, and in files with a wrong table of leaf sizes.
 * - Several files are a series of time steps. The times are the metadata "time" of the files or of
 *   their first grids, or 0, 1, 2... if a file has no time or the times do not increase. A request
 *   for a time between two steps returns the earlier step.
 *
 * @par Errors
 * - Before a grid is read, all supported grids of the file are validated down to the last leaf. A
 *   damaged file is an error with an ErrorCode, and the output is empty.
 * - A file with a format version below 222 is an error. OpenVDB 2.0 and later write 222 or above.
 */

#ifndef vtkActiveVDBReader_h
#define vtkActiveVDBReader_h

#include "vtkActiveIOModule.h" // for the export macro
#include "vtkDataObjectAlgorithm.h"

#include <memory> // for Internals
#include <string> // for names
#include <vector> // for lists of names

class vtkImageData;
class vtkPolyData;
class vtkStringArray;

class VTKACTIVEIO_EXPORT vtkActiveVDBReader : public vtkDataObjectAlgorithm
{
public:
  static vtkActiveVDBReader* New();
  vtkTypeMacro(vtkActiveVDBReader, vtkDataObjectAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * File name or, with AddFileName, names of the files of a series in order. SetFileName replaces
   * all names. Default: none, which is an error.
   */
  void SetFileName(const char* name);
  void AddFileName(const char* name);
  void ClearFileNames();
  int GetNumberOfFileNames() const { return static_cast<int>(this->FileNames.size()); }
  const char* GetFileName(int i = 0) const;
  ///@}

  ///@{
  /**
   * Name of the grid to read; AddGridName adds more. Grids of equal name are called name[0] (or
   * name), name[1], name[2]... Default: none, which reads the first level set, else the first fog,
   * else the first points, else the first grid of any other kind.
   */
  void SetGridName(const char* name);
  void AddGridName(const char* name);
  void ClearGridNames();
  ///@}

  enum Regions
  {
    ACTIVE = 0,
    INDEX = 1,
    WORLD = 2
  };

  ///@{
  /**
   * Part of a volume that becomes the image. ACTIVE (0): the box of all active voxels. INDEX (1):
   * IndexRegion. WORLD (2): the voxels that cover WorldRegion. Default: ACTIVE.
   */
  vtkSetClampMacro(Region, int, ACTIVE, WORLD);
  vtkGetMacro(Region, int);
  void SetRegionToActive() { this->SetRegion(ACTIVE); }
  void SetRegionToIndex() { this->SetRegion(INDEX); }
  void SetRegionToWorld() { this->SetRegion(WORLD); }
  ///@}

  ///@{
  /**
   * Box in index coordinates of the grid: x min, x max, y min... inclusive. With INDEX, an empty
   * box is an error. Default: 0 -1 0 -1 0 -1, empty.
   */
  vtkSetVector6Macro(IndexRegion, int);
  vtkGetVector6Macro(IndexRegion, int);
  ///@}

  ///@{
  /**
   * Box in space [length]: x min, x max, y min... With WORLD, an empty box is an error. Default: 1
   * -1 1 -1 1 -1, empty.
   */
  vtkSetVector6Macro(WorldRegion, double);
  vtkGetVector6Macro(WorldRegion, double);
  ///@}

  ///@{
  /**
   * Stride of the voxels that are read along each axis. Voxels whose index coordinates are
   * multiples of the factor are read without averaging. Range: 1 to 4096. Default: 1, all voxels.
   */
  vtkSetClampMacro(DownsamplingFactor, int, 1, 4096);
  vtkGetMacro(DownsamplingFactor, int);
  ///@}

  ///@{
  /**
   * Converts volumes to dense images. Off: the image has no arrays. If the first chosen grid is a
   * level set, the image carries the grid, for a vtkActiveImplicitSurface or a vtkGridPotential.
   * Default: on.
   */
  vtkSetMacro(OutputDense, vtkTypeBool);
  vtkGetMacro(OutputDense, vtkTypeBool);
  vtkBooleanMacro(OutputDense, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Memory limit: a dense image, or a points grid, with more points than this number is an error.
   * Range: >= 1. Default: 200000000.
   */
  vtkSetClampMacro(MaximumNumberOfPoints, vtkIdType, 1, VTK_ID_MAX);
  vtkGetMacro(MaximumNumberOfPoints, vtkIdType);
  ///@}

  ///@{
  /**
   * Grids of the file, or of that file of a series that was read last; available after
   * UpdateInformation(). The type is the value type (float, double, int32, int64, bool, mask,
   * vec3s, vec3d, vec3i, points), or the tree's type if the value type is unknown. If a file stores
   * a floating-point grid as half floats, GetGridIsHalfFloat() is true. The class is a text of the
   * file such as "level set" or "fog volume", else "unknown". GetGridIsInstance() is true if the
   * grid shares the tree of another grid. GetGridBox() returns the box of the active voxels in
   * index coordinates. An index out of range returns an empty text, 0, false or an empty box.
   */
  int GetNumberOfGrids();
  vtkStringArray* GetGridNames();
  const char* GetGridName(int i);
  const char* GetGridType(int i);
  const char* GetGridClass(int i);
  bool GetGridIsHalfFloat(int i);
  bool GetGridIsInstance(int i);
  vtkIdType GetGridActiveVoxels(int i);
  void GetGridBox(int i, int box[6]);
  void GetGridVoxelSize(int i, double size[3]);
  ///@}

  ///@{
  /**
   * Metadata as text. GetMetadata returns the value of a name, or an empty text if there is none.
   * GetAllMetadata returns a line "name: value" for each entry, or "name" if the value is empty.
   * The methods with "Grid" in their names return the metadata of a grid.
   */
  std::string GetMetadata(const std::string& name);
  std::string GetAllMetadata();
  std::string GetGridMetadata(int i, const std::string& name);
  std::string GetAllGridMetadata(int i);
  ///@}

  ///@{
  /** Return the output, or null if the output is of another class. */
  vtkImageData* GetImageOutput();
  vtkPolyData* GetPolyDataOutput();
  ///@}

protected:
  vtkActiveVDBReader();
  ~vtkActiveVDBReader() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;

private:
  vtkActiveVDBReader(const vtkActiveVDBReader&) = delete;
  void operator=(const vtkActiveVDBReader&) = delete;

  struct Internals;

  int Fail(vtkInformationVector* output, const char* sentence);
  void OpenFile(vtkInformation* output);
  void PublishExtent(vtkInformation* output) const;
  void FillOutput(vtkDataObject* data);

  std::vector<std::string> FileNames;
  std::vector<std::string> GridNames;
  int Region = ACTIVE;
  int IndexRegion[6] = { 0, -1, 0, -1, 0, -1 };
  double WorldRegion[6] = { 1.0, -1.0, 1.0, -1.0, 1.0, -1.0 };
  int DownsamplingFactor = 1;
  vtkTypeBool OutputDense = 1;
  vtkIdType MaximumNumberOfPoints = 200000000;

  std::unique_ptr<Internals> Internal;
};

#endif
