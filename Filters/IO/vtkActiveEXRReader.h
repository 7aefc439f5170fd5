/**
 * @class   vtkActiveEXRReader
 * @brief   reads .exr images: all layers, as arrays
 *
 * One part of a file becomes an image of one slice. The point arrays are the layers of the part.
 *
 * @par Arrays
 *   | Channels of the file            | Array of the image            |
 *   | ------------------------------- | ----------------------------- |
 *   | R, G, B, A or R, G, B           | RGBA or RGB, made the scalars |
 *   | N.X, N.Y, N.Z (or x, y, z)      | N, of three components        |
 *   | forward.u, forward.v            | forward, of two components    |
 *   | diffuse.R, diffuse.G, diffuse.B | diffuse: three; four with .A  |
 *   | weights.0, weights.1, ...       | weights                       |
 *   | others, as Z, id or light.key   | of the channel's name         |
 *
 * - HALF and FLOAT are read as float without loss, including NaN and infinity. UINT is read as
 *   unsigned int.
 * - Colors are not converted: in EXR files they are linear.
 * - A sample of a subsampled channel is repeated over its pixels.
 * - Scanline files are read, and the finest level of tiled files. Deep data is an error.
 * - Attributes of the header become field data of the output, by their names, if their type is int,
 *   float, double, rational, chromaticities, box2i, v2i, v2f, v3f, m33f, m44f, floatvector, string,
 *   stringvector, timecode or compression.
 *
 * @par Pixels
 * - Rows are VTK's, from below: point (0, 0) is the lower left pixel of the display window,
 *   whatever the file's own coordinates.
 * - By default the extent is the data window (see Window), which may begin at any pixel, and exceed
 *   the display window.
 *
 * @par Series
 * - Several files (SetFileNames, of vtkImageReader2) are the time steps of a series. The times are
 *   the attribute "time" of the headers, which vtkActiveEXRWriter writes. If a header has no time,
 *   or the times do not increase from file to file, the times are 0, 1, 2 and so on.
 * - The extent covers the extents of all files, with 0 where a file has no pixel.
 * - A request for a time between two steps returns the earlier step.
 *
 * @par Properties and classes of VTK
 * - Of vtkImageReader2, only the properties FileName, FileNames, DataSpacing, DataOrigin,
 *   MemoryBuffer and MemoryBufferLength have an effect.
 * - vtkImageReader2Factory finds the reader after RegisterWithFactory(), which the Python package
 *   calls.
 *
 * @par Errors
 * - A file that is missing, truncated, damaged or no EXR file, or needs more than MaximumMemory, is
 *   an error. ErrorCode returns the kind of error (vtkErrorCode), and the output is empty.
 * - Sizes in a header are validated against the file size before memory is allocated.
 */

#ifndef vtkActiveEXRReader_h
#define vtkActiveEXRReader_h

#include "vtkActiveIOModule.h" // for the export macro
#include "vtkImageReader2.h"

#include <memory> // for Series

class VTKACTIVEIO_EXPORT vtkActiveEXRReader : public vtkImageReader2
{
public:
  static vtkActiveEXRReader* New();
  vtkTypeMacro(vtkActiveEXRReader, vtkImageReader2);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Makes vtkImageReader2Factory return this reader for .exr files. A second call does nothing.
   */
  static void RegisterWithFactory();

  /**
   * Returns 3 if the file begins as an EXR file does, else 0.
   */
  int CanReadFile(VTK_FILEPATH const char* name) override;
  const char* GetFileExtensions() override { return ".exr"; }
  const char* GetDescriptiveName() override;

  ///@{
  /**
   * Add the files of a series one by one, as an alternative to SetFileNames.
   */
  void AddFileName(VTK_FILEPATH const char* name);
  void ClearFileNames();
  ///@}

  ///@{
  /**
   * Index of the part to read in a multi-part file. Range: >= 0. Default: 0.
   */
  vtkSetClampMacro(Part, int, 0, VTK_INT_MAX);
  vtkGetMacro(Part, int);
  ///@}

  enum WindowType
  {
    DATA = 0,
    DISPLAY = 1
  };

  ///@{
  /**
   * Window of the file that the image covers. DATA (0): the data window, all pixels of the file.
   * DISPLAY (1): the display window, where pixels outside are cropped and missing pixels are 0.
   * Default: DATA.
   */
  vtkSetClampMacro(Window, int, DATA, DISPLAY);
  vtkGetMacro(Window, int);
  void SetWindowToData() { this->SetWindow(DATA); }
  void SetWindowToDisplay() { this->SetWindow(DISPLAY); }
  ///@}

  ///@{
  /**
   * Memory limit for the pixels of an image and for unpacking one chunk of lines or one tile [MiB].
   * A file that needs more is an error. Range: >= 1. Default: 4096.
   */
  vtkSetClampMacro(MaximumMemory, int, 1, VTK_INT_MAX);
  vtkGetMacro(MaximumMemory, int);
  ///@}

  ///@{
  /**
   * Parts of the file, or of the first file of a series; available after UpdateInformation(). The
   * name of an unnamed part is empty; an index out of range returns null. Types are scanlineimage,
   * tiledimage, deepscanline and deeptile.
   */
  int GetNumberOfParts();
  const char* GetPartName(int part);
  const char* GetPartType(int part);
  ///@}

  ///@{
  /**
   * Channels of the selected part, sorted by name; available after UpdateInformation(). Types are
   * UINT (0), HALF (1) and FLOAT (2). An index out of range returns null or -1.
   */
  int GetNumberOfChannels();
  const char* GetChannelName(int index);
  int GetChannelType(int index);
  ///@}

  enum PixelType
  {
    UINT = 0,
    HALF = 1,
    FLOAT = 2
  };

  ///@{
  /**
   * Select channels to read by name; at first all are selected. A channel may be selected before
   * the file is read. The selected channels form arrays by the table above. To select a few
   * channels, call DisableAllChannels() before EnableChannel().
   */
  void EnableChannel(const char* name);
  void DisableChannel(const char* name);
  void EnableAllChannels();
  void DisableAllChannels();
  bool IsChannelEnabled(const char* name);
  ///@}

protected:
  vtkActiveEXRReader();
  ~vtkActiveEXRReader() override;

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override;

private:
  vtkActiveEXRReader(const vtkActiveEXRReader&) = delete;
  void operator=(const vtkActiveEXRReader&) = delete;

  struct Series;

  void NameFiles();
  void ScanFiles();
  void Publish(vtkInformation* information);
  void ReadStep(vtkInformation* information);
  int Fail(unsigned long code, const std::string& sentence, vtkInformationVector* outputs);

  int Part = 0;
  int Window = DATA;
  int MaximumMemory = 4096;
  std::unique_ptr<Series> Files;
};

#endif
