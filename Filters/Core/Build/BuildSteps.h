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

/** Tells whoever watches a build what comes next. */
void Tell(const BuildOptions& options, const char* phase, double begin, double end);

/** The steps of a build. Each metric has them in an order of its own. */
class BuildSteps
{
public:
  /** Classifies the diamonds. All but the region must outlive it, and the loops, too. */
  BuildSteps(const Source& source, const Isoregion& region, const BuildOptions& options,
    double errorScale, const ParallelFor& parallelFor);

  /** The same of a volume that comes in slabs. @param signs of all of its samples, without the
   *  pieces that are too small */
  BuildSteps(const Source& source, SignLattice signs, const Isoregion& region,
    const BuildOptions& options, double errorScale, const ParallelFor& parallelFor);

  /** What is known of an RI, whose error codes are Always, before its isovertices. */
  const EncodingHeader& RelevantHeader() const { return this->Header; }
  const DiamondSet& Relevant() const { return this->Members; }
  /** That the diamonds are of; null if they are all. */
  const PeerPortion* PortionOfPeers() const { return this->Portion ? &*this->Portion : nullptr; }
  const SignLattice* SignsIfKept() const { return this->Signs ? &*this->Signs : nullptr; }

  /** An RI without errors. @param begin, end of its part of the whole @param withEdges see Encode()
   */
  Encoded PlaceIsovertices(double begin, double end, bool withEdges = true) const;

  /** Once isovertices are placed, signs are needed for what lies inside an interval volume only. */
  void DropSigns();

  /** What tells by which field errors the diamonds are subdivided. */
  FieldMetric ByField() const;

  /** Field errors that are known already: of a volume that came in slabs. */
  void SetFieldCodes(DiamondCodes codes) { this->FieldCodes = std::move(codes); }

  ///@{
  /** Done with peers, as what follows. */
  DiamondCodes MeasureField() const;
  DiamondCodes MeasureDistances(
    const IsodiamondHierarchy& relevant, const Finiteness& isFinite) const;
  ///@}

  /** What one mesh subdivides, in the place of thresholds: ToleratedSet(). Not where what is inside
   *  is refined. @param accepted the greatest code that is tolerated of a diamond */
  std::vector<ErrorCode::Type> RefineTo(const IsodiamondHierarchy& relevant,
    const Finiteness& isFinite, const std::function<ErrorCode::Type(const Place&)>& accepted) const;

  /** Sets the thresholds of an RI. */
  static void SetThresholds(const std::vector<ErrorCode::Type>& thresholds, Encoding& relevant);

  /** Own errors become thresholds. Of the field metric nothing follows: an HD, which is to give the
   *  same mesh, has no thresholds to tell. */
  void FindThresholds(DiamondCodes& codes) const;

  Encoding Complete(Model model, Encoding relevant, DiamondCodes thresholds) const;

  /** The same where this process has a portion. @param hierarchy of the encoding */
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
  std::optional<SignLattice> Signs; ///< kept where samples do not say the same, or are not at hand
  Classification Kinds;
  std::optional<DiamondCodes> FieldCodes; ///< if they are known already
  DiamondMask ForTopology;                ///< empty if topology need not be preserved
  std::optional<PeerPortion> Portion;
  DiamondSet Members;
  EncodingHeader Header;
};

}

#endif
