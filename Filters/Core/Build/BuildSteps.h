// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_BuildSteps_h
#define isodiamond_BuildSteps_h

#include "Build/Classification.h"
#include "Build/OwnErrors.h"
#include "Field/PeerPortion.h"

#include <functional>
#include <optional>
#include <utility>

namespace isodiamond
{

/** Reports the next phase of a build, if anyone is watching. */
void Tell(const BuildOptions& options, const char* phase, double begin, double end);

/** The steps of a build. Each metric takes them in its own order. */
class BuildSteps
{
public:
  /** Classifies the diamonds. All arguments but the region must outlive it, parallelFor too. */
  BuildSteps(const Source& source, const Isoregion& region, const BuildOptions& options,
    double errorScale, const ParallelFor& parallelFor);

  /** The same for a volume that comes in slabs. @param signs of all its samples, without the pieces
   *  that are too small */
  BuildSteps(const Source& source, SignLattice signs, const Isoregion& region,
    const BuildOptions& options, double errorScale, const ParallelFor& parallelFor);

  /** What is known of an RI whose error codes are Always, before isovertices are placed. */
  const EncodingHeader& RelevantHeader() const { return this->Header; }
  const DiamondSet& Relevant() const { return this->Members; }
  /** The portion that the diamonds make up; null if they are all. */
  const PeerPortion* PortionOfPeers() const { return this->Portion ? &*this->Portion : nullptr; }
  const SignLattice* SignsIfKept() const { return this->Signs ? &*this->Signs : nullptr; }

  /** An RI without errors. @param begin, end of its part of the whole @param withEdges see Encode()
   */
  Encoded PlaceIsovertices(double begin, double end, bool withEdges = true) const;

  /** Once isovertices are placed, signs are needed only for what lies inside an interval volume. */
  void DropSigns();

  /** The metric that decides by which field errors the diamonds are subdivided. */
  FieldMetric ByField() const;

  /** Sets field errors that are known already: those of a volume that came in slabs. */
  void SetFieldCodes(DiamondCodes codes) { this->FieldCodes = std::move(codes); }

  ///@{
  /** Done together with peers, as is what follows. */
  DiamondCodes MeasureField() const;
  DiamondCodes MeasureDistances(
    const IsodiamondHierarchy& relevant, const Finiteness& isFinite) const;
  ///@}

  /** What one mesh subdivides, instead of thresholds: ToleratedSet(). Not if the interior is
   *  refined. @param accepted the greatest code that is tolerated of a diamond */
  std::vector<ErrorCode::Type> RefineTo(const IsodiamondHierarchy& relevant,
    const Finiteness& isFinite, const std::function<ErrorCode::Type(const Place&)>& accepted) const;

  /** Sets the thresholds of an RI. */
  static void SetThresholds(const std::vector<ErrorCode::Type>& thresholds, Encoding& relevant);

  /** Turns own errors into thresholds. With the field metric there are no followers: an HD, which
   *  is to give the same mesh, has no thresholds to find them by. */
  void FindThresholds(DiamondCodes& codes) const;

  Encoding Complete(Model model, Encoding relevant, DiamondCodes thresholds) const;

  /** The same if this process has a portion. @param hierarchy made from the encoding */
  Encoding CompleteOfPortions(Model model, Encoding relevant, const IsodiamondHierarchy& hierarchy,
    DiamondCodes thresholds) const;

private:
  DiamondSet KeptOf(Model model) const;
  template <typename Work>
  void Do(const char* phase, double begin, double end, const Work& work) const;
  void Merge(std::vector<ErrorCode::Type>& codes) const;
  void SubdivideAlways(DiamondCodes& codes) const;
  BuildSigns SignsToGoBy() const;

  const Source& Origin;
  const BuildOptions& Options;
  const ParallelFor& For;
  bool Interior;                    ///< whether it is refined
  std::optional<SignLattice> Signs; ///< kept if samples do not say the same, or are not at hand
  Classification Kinds;
  std::optional<DiamondCodes> FieldCodes; ///< if they are known already
  DiamondMask ForTopology;                ///< empty if topology need not be preserved
  std::optional<PeerPortion> Portion;
  DiamondSet Members;
  EncodingHeader Header;
};

}

#endif
