#include "hal/hl2ss/server/unity_scene.h"

#include <gmock/gmock.h>

#include <cmath>

#include "base/random.h"
#include "tests/hal/hl2ss/scene_peer.h"

namespace orthonav::test {
namespace {

using Message = std::vector<std::uint8_t>;

/// Written from the description, as the peer is.
Message message(std::uint32_t command, const Message& payload = {}) {
  Message bytes;
  for (const std::uint32_t word : {command, static_cast<std::uint32_t>(payload.size())}) {
    for (int i = 0; i < 4; ++i) {
      bytes.push_back(static_cast<std::uint8_t>(word >> (8 * i)));
    }
  }
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  return bytes;
}

Message words(std::initializer_list<std::uint32_t> numbers) {
  Message bytes;
  for (const std::uint32_t number : numbers) {
    for (int i = 0; i < 4; ++i) {
      bytes.push_back(static_cast<std::uint8_t>(number >> (8 * i)));
    }
  }
  return bytes;
}

void tell(hl2ss::UnityScene& scene, const Message& bytes) {
  const auto read = hl2ss::read_scene_message(bytes);
  ASSERT_TRUE(read && *read);
  scene.add(**read);
}

std::vector<std::uint32_t> frame(hl2ss::UnityScene& scene) {
  std::vector<std::uint32_t> answers;
  scene.run_frame(answers);
  return answers;
}

TEST(UnityScene, DoesOneCommandAFrameAndAListInOne) {
  hl2ss::UnityScene scene;
  for (int i = 0; i < 3; ++i) {
    tell(scene, message(8));
  }
  EXPECT_EQ(frame(scene).size(), 1u);
  EXPECT_EQ(frame(scene).size(), 1u);
  tell(scene, message(18));
  tell(scene, message(8));
  tell(scene, message(19));
  tell(scene, message(8));
  EXPECT_EQ(frame(scene).size(), 1u);
  EXPECT_EQ(frame(scene).size(), 3u) << "the list";
  EXPECT_EQ(frame(scene).size(), 1u);
  EXPECT_EQ(frame(scene).size(), 0u);
}

TEST(UnityScene, AnOpenListEndsTheFrameWhenNothingWaits) {
  hl2ss::UnityScene scene;
  tell(scene, message(18));
  tell(scene, message(8));
  EXPECT_EQ(frame(scene).size(), 2u);
  tell(scene, message(8));
  tell(scene, message(8));
  EXPECT_EQ(frame(scene).size(), 2u) << "the list is still open";
}

TEST(UnityScene, AClientThatLeftIsWorkedOffAndResets) {
  hl2ss::UnityScene scene;
  tell(scene, message(0, words({3})));
  tell(scene, message(18));
  tell(scene, message(20, words({1})));
  scene.client_left();
  tell(scene, message(8));
  tell(scene, message(8));
  EXPECT_EQ(frame(scene).size(), 1u);
  EXPECT_EQ(frame(scene).size(), 0u) << "the list; nobody is there to be answered";
  EXPECT_EQ(frame(scene).size(), 1u) << "no list any more";
  EXPECT_EQ(scene.objects().size(), 1u) << "nothing is removed";
}

TEST(UnityScene, AnswersZeroToWhatItDoesNotKnow) {
  hl2ss::UnityScene scene;
  for (const std::uint32_t command : {9u, 15u, 21u, 0xFFFF'FFFEu, 1u, 2u, 16u}) {
    tell(scene, message(command, words({5, 1})));
    EXPECT_EQ(frame(scene), std::vector<std::uint32_t>{0}) << command;
  }
}

/// One of the commands with a target among `ids`, mostly whole.
Message drawn(Random& random, const std::vector<std::uint32_t>& ids) {
  const auto command = static_cast<std::uint32_t>(random.uniform(0, 22));
  Message payload;
  if (command == 0 || command == 20) {
    payload = words({static_cast<std::uint32_t>(random.uniform(0, command == 0 ? 8 : 2))});
  } else if (command >= 1 && command <= 16 && command != 6 && command != 8) {
    const std::size_t index =
        static_cast<std::size_t>(random.uniform(0, 1.2) * static_cast<double>(ids.size()));
    payload = words({index < ids.size() ? ids[index] : 4u});
    const std::size_t numbers = command == 1 ? 1 : command <= 3 ? 10 : command == 7 ? 7 : 4;
    for (std::size_t i = 0; i < numbers; ++i) {
      const auto number = static_cast<float>(random.uniform(-2, 2));
      const auto* bytes = reinterpret_cast<const std::uint8_t*>(&number);
      payload.insert(payload.end(), bytes, bytes + 4);
    }
  }
  if (random.uniform() < 0.1 && !payload.empty()) {
    payload.resize(payload.size() / 2);
  }
  return message(command, payload);
}

void expect_same(const hl2ss::UnityObject& ours, const ScenePeer::Thing& theirs) {
  EXPECT_EQ(ours.active, theirs.visible);
  EXPECT_EQ(ours.on_head, theirs.follows_head);
  EXPECT_EQ(ours.is_text, theirs.text);
  EXPECT_EQ(ours.text, theirs.words);
  EXPECT_EQ(static_cast<float>(ours.position_m.x), theirs.place[0]);
  EXPECT_EQ(static_cast<float>(-ours.position_m.z), theirs.place[2]);
  EXPECT_EQ(static_cast<float>(-ours.rotation.x), theirs.place[3]);
  EXPECT_EQ(static_cast<float>(ours.rotation.z), theirs.place[5]);
  EXPECT_EQ(static_cast<float>(ours.scale.y), theirs.place[8]);
  EXPECT_EQ(ours.colour.b, theirs.rgba[2]);
}

TEST(UnityScene, AgreesWithASecondImplementation) {
  hl2ss::UnityScene ours;
  ScenePeer theirs;
  Random random(11);
  std::vector<std::uint32_t> our_ids;
  std::vector<std::uint32_t> their_ids;
  std::size_t answered = 0;
  for (int i = 0; i < 4000; ++i) {
    Random again = random.fork(static_cast<std::uint64_t>(i));
    Random same = again;
    tell(ours, drawn(again, our_ids));
    theirs.hear(drawn(same, their_ids));
    const auto our_answers = frame(ours);
    const auto their_answers = theirs.frame();
    ASSERT_EQ(our_answers.size(), their_answers.size()) << i;
    for (std::size_t k = 0; k < our_answers.size(); ++k, ++answered) {
      ASSERT_EQ(our_answers[k] > 1, their_answers[k] > 1) << i;
      if (our_answers[k] > 1) {
        our_ids.push_back(our_answers[k]);
        their_ids.push_back(their_answers[k]);
      } else {
        ASSERT_EQ(our_answers[k], their_answers[k]) << i;
      }
    }
    ASSERT_EQ(ours.objects().size(), theirs.things.size()) << i;
    for (std::size_t k = 0; k < our_ids.size(); ++k) {
      const auto found = ours.objects().find(our_ids[k]);
      ASSERT_EQ(found != ours.objects().end(), theirs.things.count(their_ids[k]) == 1) << i;
      if (found != ours.objects().end()) {
        expect_same(found->second, theirs.things.at(their_ids[k]));
      }
    }
  }
  EXPECT_EQ(answered, 4000u);
  EXPECT_GT(our_ids.size(), 100u);
}

}  // namespace
}  // namespace orthonav::test
