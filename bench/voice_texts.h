#pragma once

#include <string_view>

namespace orthonav::bench {

/// Talk in an operating room without commands. Two sets without common sentences: thresholds were
/// chosen on the first, and results are reported on the second.
inline constexpr std::string_view kTuningTalk[] = {
    "We saved the scan from yesterday in the same folder.",
    "Could you pass me the small retractor, please?",
    "He was delayed at the airport and started late.",
    "The next patient is already waiting downstairs.",
    "I do not accept that as a reason.",
    "Okay.",
    "That is quite safe, I believe.",
    "Hold the suction a little lower.",
    "Her daily dose was reduced last week.",
    "Yes, go on.",
    "They rejected the first proposal in the spring.",
    "When we are done with this one, we take a short break.",
    "My sister's twins are starting school.",
    "Move the lamp a little towards me.",
    "It is on the left side.",
    "The screws are six millimetres thick.",
    "Thanks.",
    "Nobody deleted anything, the disk was full.",
    "Save your strength for the afternoon.",
    "I would start with the lower level.",
    "Two more minutes.",
    "The rod has to be bent a little more than that.",
    "How is the pressure?",
    "Right.",
    "We shaved the area this morning.",
    "She said the text was too long.",
    "Turn the radio down, please.",
    "There were ten of them in the box.",
    "What did the radiologist say about the lateral view?",
    "That one is mine.",
};

/// Words that are no commands, said after the wake word where one is expected: the answers that are
/// given most; those on which the evidence was weighed and the line drawn; and those that are
/// measured, among them parts of commands and commands' names.
inline constexpr std::string_view kAskedWords = "stop, okay, yes, no, confirm, undo, reset";
inline constexpr std::string_view kTuningWords =
    "a little more, a new rod, able, about, above, accept level, accept that, accept this one, "
    "accident, account, accurate, acid, across, active, add, advice, afternoon, age, agreed, "
    "ahead, align, all done, all right, almost, already, always, amazing, and now, animal, annex, "
    "anterior, antibiotic, any, approve, arrow, artery, ask, assist, audio, autumn, awake, awl, "
    "back, bad, balance, ball, band, basic, beautiful, because, before, begin, begin again, begin "
    "driving, begin it, begin level, begin plan, beginning, behind, bell, belt, between screws, "
    "big, big guiding, bigger, bill, bit, black, blade, block, blood, blue, board, body, book, "
    "box, brain, branch, brave, break, breathe, bright, brighter, brown, build, bus, busy, buy, "
    "calculate, call, camera, capture, card, care, careful, carry, case, catch, cause, cave, "
    "certain, chair, chance, chart, chest, child, chin, choice, circle, city, class, clear, "
    "close, coffee, collar, color, come, common, company, complete, complete last, concept, "
    "condition, contact, context, continue, control, cook, copy, corner, could be, country, "
    "course, cross, cup, current, daily, danger, dark, dart, date, dawn, day, deceit, decide, "
    "deep, defeat, delay, delayed, delete all, delete it all, delete level, delete "
    "rod, deliver, dentist, deny, deplete, desk, detail, difficult, digit, dilute, dinner, "
    "direct, display, distance, distant, do it, do not accept, do not start, do that, doctor, "
    "don't delete, donor, door, dress, drive, drop, during, each, early, earth, eat, education, "
    "effect, effort, eighteen, eject, electric, eleven, elite, end, engine, english, entry, even, "
    "event, every, evidence, examine, example, except, except that, exempt, exempt result, "
    "exercise, exit, expect results, expert, eye, face, fact, fall, family, famous, famous rod, "
    "faster, father, feel, fifty, fight, figure, fill, find, finger, finish, finish all, finish "
    "it off, finish level now, finish now, finish plan, finish points, finish red, finish road, "
    "finish screw, finish that, finished, finished rod, finnish, first, fish, fishing rod, fit, "
    "floor, flower, fluid, fly, food, forty, forward, found, four, frame, free, freeze, friday, "
    "friend, front, fruit, future, garden, gas, gate, general, get, girl, give, glass, go, go "
    "ahead, go away, go back, go home, go next, go on, go to axis, go to bed, go to last, go to "
    "text, go to the next patient, go to work, goat next, goes, gold, gone, goodbye, government, "
    "great, green, grey, ground, group, grow, guiding, hair, half, hammer, happy, head, hear, "
    "help, help me, here, hide, high, history, hit, hold, hole, hope, horse, hospital, hour, "
    "house, how much, hundred, hurry, husband, ice, idea, important, increase, index, industry, "
    "information, inject, inspect, iron, island, it is next, job, judge, keep guiding, keyboard, "
    "kick, kind, king, kitchen, know, lady, lamp, land, language, large, last, last one, laugh, "
    "law, lay, lead, learn, leave, left, leg, lesson, let's go, letter, level, life, lift, like, "
    "line, lip, list, listen, little, local, lost, lot, love, low, lower, lumbar, lunch, machine, "
    "make, man, many, market, marry, may, meal, meat, meeting, member, metal, mind, minute, "
    "mister, mixed, model, money, month, moon, more, morning, most, mother, mountain, mouth, "
    "move, move contemplate, move forward, move him, move it, move level, move on, move rod, move "
    "screw, move tablet, move temple, move to next, movement, movie, muscle, music, mute, name, "
    "neck, necks, need, needed next, needle, nerve, nest, network, never mind, new rod, new "
    "template, new temple, newspaper, next level, next one, next rod, next screw, next time, "
    "nine, no next, no result, no way, noise, none, north, nose, not done, note, notice, object, "
    "object to this, october, off, offer, office, often, oil, old, once, one more, one more "
    "screw, one screw, one two, only, operate, order, other, our, own, oxygen, pack, pain, pair, "
    "parent, park, part, past, patient, pause, pay, people, person, phone, picture, piece, plain, "
    "plant, please, please wait, plenty, plus, pocket, point it, points, police, poor, possible, "
    "post, pound, practice, present, pressure, previous, price, private, probe, problem, product, "
    "program, project, promise, proper, protect, proud, public, pump, pure, put, queen, question, "
    "quit, quite, radio, rail, rain, reach, react, read, reason, receive, reduce, refuse, "
    "register, reject it all, reject plan, reject that, rejected, relate, remember, remove "
    "template, repeat, reset level, respect, rest, retractor, return, rich, ride, ring, rise, "
    "river, road, rock, rod, roof, root, rope, round, rule, ruler, run, sad, salt, same, same "
    "points, sand, saturday, save as, save it all, save last, save level, save time, say, say "
    "again, scale, scan, school, science, screw, screwdriver, sea, search, season, second, see, "
    "sell, sense, serious, serve, seventy, several, shape, she, sheet, ship, shirt, shoe, shoot, "
    "shop, short, shoulder, shout, side, silver, since, sing, sister, sit, six, sixteen, skin, "
    "sky, small, smart, smile, smoke, snow, so, some, song, soon, sound, south, space, speak, "
    "special, speed, spell, spend, spine, sport, spread, spring, square, stage, star, stark, "
    "start over, starting, starts, state, station, stay, steel, step, stick, still, stock, "
    "stomach, stone, stop guarding, stored, story, strange, street, stretch, strike, string, "
    "stuck, student, study, subject, subject to that, success, such, sugar, suggest, summer, "
    "sunday, supply, sure, surface, surprise, sweet, swim, system, table top, talk, tall, taste, "
    "teach, team, temperature, template, temporal, temporary, ten, than, thank you, the last, the "
    "level, the next, the result, theatre, thin screw, thing, think, third, thirty, this level, "
    "this screw, thousand, thread, three, three screws, throat, through, throw, tie, time, tin "
    "screw, to next, today, tomorrow, ton, tongue, tonight, too, tooth, top, total, town hall, "
    "trade, travel, tree, trouble, truck, trust, tuesday, turn it off, tween, twenty, twenty "
    "screws, twenty two, twice, twin beds, twin crew, twin rod, twine, twist, two, two in screw, "
    "two points, type, uncle, understand, undone, until, up, update, upper, upset, usual, valley, "
    "value, vein, vertebra, vessel, vexed, view, visit, voice, volume, vote, wait a moment, wall, "
    "want, war, water, way, weak, wear, week, weight, west, wet, what is this, wheel, when, why, "
    "wife, wild, win, win screw, wind, winner, winter, wire, wish, with me, woman, wonder, wood, "
    "word, world, worry, yard, year, yesterday, young, zero, zoom";
inline constexpr std::string_view kUnseenWords =
    "accent, accept, accept it, accept none, accept plan, adept, again, agree, art, asset, "
    "athlete, attempt, backward, battery, begin, best, calibrate, cancel, check, choose, come on, "
    "correct, decline, delegate, delete, delete it, delete nothing, delete plan, deletes, "
    "delight, depart, discard, done, drill, dung, eight, elect, end guiding, enough, enter, "
    "erase, exact, excerpt, expect, extract, false, finish it, finish level, five, forget, fun, "
    "gave, glasses, go to start, good, good morning, headset, heart, hello, higher, hold on, "
    "home, image, implant, improve, inept, keep, less, light, load, louder, mark, measure, menu, "
    "message, mood, motor, move it away, move road, move the lamp, next, nexus, not this one, not "
    "yet, nothing, nun, open, over, pedicle, perfect, photo, plan, play, pointer, power, quieter, "
    "ready, reboot, record, regret, reject, reject it, reject result, remove, remove rod, "
    "removed, restart, retract, sacrum, sane, save, save it, save plan, saving, scalpel, screen, "
    "select, settings, seven, show, slave, sleep, slower, smaller, sorry, sort, stack, stars, "
    "start, startle, status, stop guiding, store, sun, table, tap, target, that's it, thin, too "
    "far, town, train, true, twin, two screws, video, wait, wave, weather, what now, wrong, yes "
    "please";

/// What the fresh voices say: nothing was decided on it.
inline constexpr std::string_view kFreshWords =
    "absolutely, access, action, adjust, after that, air, alert, all clear, anchor, angle, "
    "answer, any more, apply, arm, as planned, aside, attach, author, away, axis, bandage, bed, "
    "bend it, better, bipolar, bleeding, bone, both, bottom, bring it here, brush, burr, button, "
    "cable, calm down, cement, center, change, charge, clamp, clean it, click, clip, close it, "
    "cold, come here, compare, connect, cotton, count, cover, cut, deeper, depth, device, dim, "
    "disc, dose, double, down, draw, dry, easy, edge, elbow, empty, exactly, explain, fast, "
    "fetch, field, file, fine, fix, flat, flush, focus, follow, foot, force, forceps, full, "
    "further, gauze, gently, get ready, give me that, glove, got it, graft, grid, guide, hand, "
    "hard, heavy, hip, hook, hot, ignore, inside, irrigate, item, joint, jump, just a second, "
    "knife, knock, label, later, lateral, lock, long, look, loose, lumbar two, magnify, main "
    "menu, map, mask, match, maximum, medial, middle, minimum, mirror, monitor, nail, narrow, "
    "near, needle holder, negative, never, new level, new screw please, nice, night, normal, now, "
    "number, nurse, ortho, outside, page, paper, paste, path, perhaps, pick up, pin, place, "
    "planet, plate, point, polish, position, press, print, pull, push, quick, quiet, raise, rasp, "
    "really, red, release, reload, remind me, replace, report, request, result, rinse, room, "
    "rotate, route, safe, sample, scissors, scroll, send, set, share, sharp, shift, shut, sign, "
    "simple, size, skip, slide, slow, soft, sponge, stable, stand by, step back, stitch, "
    "straight, strong, submit, suction, suture, swap, switch, tablet, take, tell me, test, thanks "
    "a lot, that is fine, thick, tighten, tilt, tip, together, tool, touch, trajectory, tray, try "
    "again, tube, turn, twelve, under, unit, unlock, use this, very good, visible, wake up, walk, "
    "warm, wash, watch, well done, what is next, where is it, white, wide, window, work, write, "
    "yellow, you are right, zone";

inline constexpr std::string_view kTestTalk[] = {
    "I'll save that for later, when we are on the other side.",
    "Please be careful, this is not a safe place for the drill.",
    "The report was saved twice and one copy was deleted this morning.",
    "He has to shave twice daily, he told me.",
    "Okay.",
    "Let us look at the next image before we go on.",
    "I'm not done yet, give me another minute.",
    "The anaesthetist accepts the values as they are.",
    "Could somebody start the timer, please?",
    "Yes.",
    "We have to move the rod tray over there.",
    "It was rejected by the committee in the end.",
    "The twin study from last year said the opposite.",
    "Is the pressure still the same?",
    "Everything except the last screw is in place.",
    "Two millimetres more to the left, I think.",
    "Delete is a strong word for what happened to those files.",
    "Safe.",
    "The neck was stiff, and she had been in pain for years.",
    "Down a little.",
    "Who is on duty this evening?",
    "Say when.",
    "You can start closing on your side.",
    "Right, what is next on the list?",
    "I have never seen one like that before.",
    "Give me the long pedicle probe and keep the awl ready.",
    "None of the daily checks showed anything.",
    "Good.",
    "She had started walking again by the end of the week.",
    "Do you want to accept the call or should I take it?",
    "Careful.",
    "The saline is nearly gone, we need a new bag.",
    "They saved him a seat at the front.",
    "It is done, as far as I can tell from here.",
    "More light, please.",
    "Between the two of them there was no difference at all.",
    "The delay was not our fault.",
    "Thank you.",
    "I would rather reject it now than explain it tomorrow.",
    "Wait a moment.",
};

}  // namespace orthonav::bench
