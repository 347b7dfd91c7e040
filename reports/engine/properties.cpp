#include "reports/engine/properties.hpp"

#include <array>
#include <string_view>

namespace nearmiss {

namespace {

/// Each runs for every query of the catalogue.
constexpr std::array<std::string_view, 48> for_every_query = {
    "EveryTier.AnswersKeepTheirContract",
    "EveryTier.AnswersInNumbersOfItsScalar",
    "EveryTier.PromisesSomethingAboutMostCases",
    "EveryTierRelated.KeepsEveryRelationOfItsAnswers",
    "EveryTierRelated.KeepsEveryRelationOfItsAnswersToStoredCases",
    "EveryTierGiven.InfinityReportsNoHit",
    "EveryTierGiven.NotANumberReportsNoHit",
    "CertifiedPostconditions.FollowFromEveryAnswer",
    "CertifiedTier.IsRightAboutRawNumbersOfAnyMagnitude",
    "Codec.BringsACaseBackFromJsonText",
    "Codec.BringsACaseBackFromBytes",
    "Codec.TakesNoBytesThatAreTooFewAndIgnoresThoseBeyond",
    "Codec.TakesNoBytesThatBreakARule",
    "Codec.NamesEveryInputThatIsMissing",
    "Enclosures.ContainTheExactAnswerOfEveryInputWithinTheWidening",
    "Enclosures.ContainTheExactAnswersOfEveryFamily",
    "Enclosures.GrowWithTheWidening",
    "Enclosures.OfStoredCasesContainTheExactAnswers",
    "Enclosures.OfTheInputItselfContainTheExactAnswers",
    "FastInLanes.LeavesNothingInAMiss",
    "FastWithoutLanes.KeepsItsContract",
    "FittedCases.AreInsideAndMixYesAndNo",
    "FittedToAll.AreInsideAndMixYesAndNo",
    "FittedToAll.ChangeOnlyWhatIsOutside",
    "Generator.MakesCasesThatAreValidAndExactInTheirScalar",
    "Generator.KeepsToModerateMagnitudes",
    "Generator.GivesTheSameCaseWhateverWasMadeBefore",
    "Generator.GivesAnotherCaseForEverySeedAndIndex",
    "Generator.MixesYesAndNo",
    "Generator.MakesHalfOfTheCasesScenesAndTheOthersByMoves",
    "Generator.MutatesIntoAnotherValidCase",
    "GeneratorBalance.ReachesEveryFeatureTieAndKnifesEdgeOftenEnough",
    "Lies.AreTold",
    "Lies.AreNoExactAnswer",
    "Lies.ThatAreNotGrossAreToldToo",
    "Oracles.ExcludeOnNoRungWhatTheExactStageFinds",
    "Oracles.ExcludeMoreOnAHigherRungInFewerThanOneOfAHundredCases",
    "RelatedTruths.KeepEveryRelationOfTheirDecisions",
    "ForgetfulSubject.MakesNobodyContradictThemselves",
    "Shrinking.KeepsTheTruthAndStaysValidAndExact",
    "StoredCases.HoldAtLeastSixSeeds",
    "StoredCases.SayWhatTheyAreAbout",
    "StoredCases.AreNamedAfterTheTruth",
    "StoredCases.MeetTheirExpectations",
    "StoredCases.ComeBackFromJson",
    "WhereNothingRounds.EveryTierIsExact",
    "WorkOfTheCertified.IsBoundedWhateverTheNumbers",
    "WorkOfTheOracle.IsBoundedWhateverTheNumbers",
};

}  // namespace

std::vector<std::string> properties_of(const Query&) { return {for_every_query.begin(), for_every_query.end()}; }

}  // namespace nearmiss
