// Collectives: all ranks report, stop and fail together, and no rank waits for one that has left.

#include "Ranks/Agreement.h"
#include "Support/ThreadRanks.h"

#include <gtest/gtest.h>

#include <string>

using namespace activesurface;

namespace TestAgreement
{

namespace
{

Bytes MakeBytes(const std::string& text)
{
  return { text.begin(), text.end() };
}

// Returns the error message, which has to be the same on all ranks.
std::string RunToError(int size, const std::function<void(Agreement& ranks)>& program)
{
  std::vector<std::string> sentences(static_cast<std::size_t>(size));
  RunOnRanks(size,
    [&](Agreement& ranks)
    {
      try
      {
        program(ranks);
      }
      catch (const RankError& error)
      {
        sentences[static_cast<std::size_t>(ranks.GetRank())] = error.what();
      }
    });
  for (const std::string& sentence : sentences)
  {
    EXPECT_EQ(sentence, sentences.front());
  }
  return sentences.front();
}

}

TEST(TestAgreement, BytesComeByRank)
{
  RunOnRanks(3,
    [](Agreement& ranks)
    {
      const std::string own(static_cast<std::size_t>(ranks.GetRank()), 'x');
      const std::vector<Bytes> all = ranks.Exchange(MakeBytes(own));
      ASSERT_EQ(all.size(), 3u);
      for (std::size_t rank = 0; rank < 3; ++rank)
      {
        EXPECT_EQ(all[rank].size(), rank) << "of rank " << rank;
      }
    });
}

TEST(TestAgreement, AllStopWhereOneDoes)
{
  RunOnRanks(3,
    [](Agreement& ranks)
    {
      EXPECT_TRUE(ranks.GoOn(true)) << "nobody stops";
      EXPECT_FALSE(ranks.GoOn(ranks.GetRank() != 1)) << "rank 1 stops";
    });
}

TEST(TestAgreement, AllFailWithTheSentenceOfOne)
{
  const auto exchange = [](Agreement& ranks)
  { ranks.GetRank() == 1 ? ranks.Fail("no file.") : (void)ranks.Exchange({}); };
  EXPECT_EQ(RunToError(3, exchange), "On rank 1 of 3: no file.");
  const auto goOn = [](Agreement& ranks)
  { ranks.GetRank() == 2 ? ranks.Fail("no memory.") : (void)ranks.GoOn(true); };
  EXPECT_EQ(RunToError(3, goOn), "On rank 2 of 3: no memory.");
}

TEST(TestAgreement, TheFirstOfSeveralSentencesIsTold)
{
  const auto fail = [](Agreement& ranks)
  { ranks.Fail(ranks.GetRank() == 0 ? "no file." : "no memory."); };
  EXPECT_EQ(RunToError(2, fail), "On rank 0 of 2: no file.");
}

TEST(TestAgreement, WhatIsWrongOnAllRanksIsOfNone)
{
  EXPECT_EQ(RunToError(3, [](Agreement& ranks) { ranks.Fail("no target."); }), "no target.");
  EXPECT_EQ(RunToError(3, [](Agreement& ranks) { ranks.Fail(""); }),
    "An error without a description occurred.");
}

TEST(TestAgreement, AllKnowThatMemoryHasEnded)
{
  RunOnRanks(2,
    [](Agreement& ranks)
    {
      const auto task = [&]
      {
        if (ranks.GetRank() == 1)
        {
          throw std::bad_alloc();
        }
      };
      EXPECT_THROW(RunTogether(ranks, task), RankMemoryError);
    });
}

TEST(TestAgreement, RoundsGoOnAfterAnError)
{
  RunOnRanks(2,
    [](Agreement& ranks)
    {
      EXPECT_THROW(
        ranks.GetRank() == 0 ? ranks.Fail("no file.") : (void)ranks.Exchange({}), RankError);
      EXPECT_TRUE(ranks.GoOn(true));
    });
}

TEST(TestAgreement, AProgramOfOneProcessAgreesWithItself)
{
  Agreement alone;
  EXPECT_TRUE(alone.IsAlone());
  EXPECT_EQ(alone.Exchange(MakeBytes("x")), std::vector<Bytes>{ MakeBytes("x") });
  EXPECT_TRUE(alone.GoOn(true));
  EXPECT_FALSE(alone.GoOn(false));
  EXPECT_EQ(RunToError(1, [](Agreement& ranks) { ranks.Fail("no file."); }), "no file.");
}

// A rank without capacity for its messages fails before the other ranks send them.
TEST(TestAgreement, AllFailWhereOneHasNoRoom)
{
  const auto distribute = [](Agreement& ranks)
  {
    RunTogether(ranks,
      [&]
      {
        const std::size_t most = std::vector<char>().max_size();
        ranks.Distribute(std::vector<Bytes>(3), { 0, 0, ranks.GetRank() == 1 ? most + 1 : 0 });
      });
  };
  EXPECT_EQ(RunToError(3, distribute).substr(0, 14), "On rank 1 of 3");
}

}
