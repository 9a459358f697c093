-- Drones: 2 drone (landing.swarm:30)
--
-- Property DownOnce: each drone : starts land only after sends Taken
--
-- messages between robots arrive in any order, none is lost
-- functions, delays and messages take any time
-- functions succeed or are aborted, actions are also preempted
-- no robot and no answer of a function is lost
--
-- rumur-run --deadlock-detection off Drones_DownOnce_drone_1.m looks at all states, or finds a run that violates the property.
-- Each rule is one step of a robot, with what leads to it in the model.

const
  ROBOTS: 2;
  CAPACITY: 2; -- of one event, on their way to a robot
  SETTLED: 1;
  VIOLATED: 2;

type
  robot_drone_1: scalarset(1); -- 1 drone: drone[1]
  state_drone_1: enum {
    in_drone_1_Circle, -- Circle
    in_drone_1_Land, -- Land
    in_drone_1_Wait, -- Wait
    in_drone_1_Down -- Down
  };
  robot_drone_0: scalarset(1); -- 1 drone: drone[0]
  state_drone_0: enum {
    in_drone_0_Circle, -- Circle
    in_drone_0_Land, -- Land
    in_drone_0_Wait, -- Wait
    in_drone_0_Down -- Down
  };
  letters: enum { -- events between robots
    letter_Taken, -- Taken
    letter_Free -- Free
  };
  inbox: array [letters] of 0..CAPACITY; -- how many of each are on their way to a robot

var
  at_drone_1: array [robot_drone_1] of state_drone_1;
  inbox_drone_1: array [robot_drone_1] of inbox;
  at_drone_0: array [robot_drone_0] of state_drone_0;
  inbox_drone_0: array [robot_drone_0] of inbox;
  watch: 0..VIOLATED; -- state of the watch of the property
  count_0: 0..ROBOTS; -- robots: starts land
  count_1: 0..ROBOTS; -- robots: sends Taken
  my_count_0: 0..1; -- the robot of the property: starts land
  my_count_1: 0..1; -- the robot of the property: sends Taken

procedure send_Taken_from_drone_1(me: robot_drone_1);
begin
  for other: robot_drone_0 do
    if at_drone_0[other] != in_drone_0_Down & inbox_drone_0[other][letter_Taken] < CAPACITY then
      inbox_drone_0[other][letter_Taken] := inbox_drone_0[other][letter_Taken] + 1;
    end;
  end;
end;

procedure send_Taken_from_drone_0(me: robot_drone_0);
begin
  for other: robot_drone_1 do
    if at_drone_1[other] != in_drone_1_Down & inbox_drone_1[other][letter_Taken] < CAPACITY then
      inbox_drone_1[other][letter_Taken] := inbox_drone_1[other][letter_Taken] + 1;
    end;
  end;
end;

procedure send_Free_from_drone_1(me: robot_drone_1);
begin
  for other: robot_drone_0 do
    if at_drone_0[other] != in_drone_0_Down & inbox_drone_0[other][letter_Free] < CAPACITY then
      inbox_drone_0[other][letter_Free] := inbox_drone_0[other][letter_Free] + 1;
    end;
  end;
end;

procedure send_Free_from_drone_0(me: robot_drone_0);
begin
  for other: robot_drone_1 do
    if at_drone_1[other] != in_drone_1_Down & inbox_drone_1[other][letter_Free] < CAPACITY then
      inbox_drone_1[other][letter_Free] := inbox_drone_1[other][letter_Free] + 1;
    end;
  end;
end;

-- What is on its way to a robot that has ended does not count.
procedure end_drone_1(me: robot_drone_1);
begin
  for each: letters do
    inbox_drone_1[me][each] := 0;
  end;
end;

-- What is on its way to a robot that has ended does not count.
procedure end_drone_0(me: robot_drone_0);
begin
  for each: letters do
    inbox_drone_0[me][each] := 0;
  end;
end;

procedure look();
begin
  if watch = 0 & (my_count_0 >= 1) & (my_count_1 >= 1) then -- starts land, sends Taken
    watch := SETTLED;
  elsif watch = 0 & (my_count_0 >= 1) & !(my_count_1 >= 1) then -- starts land, not sends Taken
    watch := VIOLATED;
  elsif watch = 0 & !(my_count_0 >= 1) & (my_count_1 >= 1) then -- not starts land, sends Taken
    watch := SETTLED;
  end;
end;

startstate
begin
  for me: robot_drone_1 do
    at_drone_1[me] := in_drone_1_Circle;
    inbox_drone_1[me][letter_Taken] := 0;
    inbox_drone_1[me][letter_Free] := 0;
  end;
  for me: robot_drone_0 do
    at_drone_0[me] := in_drone_0_Circle;
    inbox_drone_0[me][letter_Taken] := 0;
    inbox_drone_0[me][letter_Free] := 0;
  end;
  watch := 0;
  count_0 := 0;
  count_1 := 0;
  my_count_0 := 0;
  my_count_1 := 0;
end;

-- 1 drone: drone[1]
ruleset me: robot_drone_1 do
  rule "do.Circle.succeeded (landing.swarm:13)"
    at_drone_1[me] = in_drone_1_Circle ==>
  begin
    at_drone_1[me] := in_drone_1_Land;
    send_Taken_from_drone_1(me);
    count_0 := count_0 + 1;
    my_count_0 := my_count_0 + 1;
    count_1 := count_1 + 1;
    my_count_1 := my_count_1 + 1;
    look();
    count_0 := count_0 - 1;
    my_count_0 := my_count_0 - 1;
    count_1 := count_1 - 1;
    my_count_1 := my_count_1 - 1;
  end;
  rule "do.Circle.aborted (landing.swarm:14)"
    at_drone_1[me] = in_drone_1_Circle ==>
  begin
    at_drone_1[me] := in_drone_1_Circle;
    look();
  end;
  rule "Taken (landing.swarm:15)"
    at_drone_1[me] = in_drone_1_Circle & inbox_drone_1[me][letter_Taken] > 0 ==>
  begin
    inbox_drone_1[me][letter_Taken] := inbox_drone_1[me][letter_Taken] - 1;
    at_drone_1[me] := in_drone_1_Wait;
    look();
  end;
  rule "Free"
    at_drone_1[me] = in_drone_1_Circle & inbox_drone_1[me][letter_Free] > 0 ==>
  begin
    inbox_drone_1[me][letter_Free] := inbox_drone_1[me][letter_Free] - 1;
    at_drone_1[me] := in_drone_1_Circle;
    look();
  end;
  rule "do.Land.succeeded (landing.swarm:20)"
    at_drone_1[me] = in_drone_1_Land ==>
  begin
    at_drone_1[me] := in_drone_1_Down;
    end_drone_1(me);
    send_Free_from_drone_1(me);
    look();
  end;
  rule "do.Land.aborted (landing.swarm:21)"
    at_drone_1[me] = in_drone_1_Land ==>
  begin
    at_drone_1[me] := in_drone_1_Land;
    count_0 := count_0 + 1;
    my_count_0 := my_count_0 + 1;
    look();
    count_0 := count_0 - 1;
    my_count_0 := my_count_0 - 1;
  end;
  rule "Taken"
    at_drone_1[me] = in_drone_1_Land & inbox_drone_1[me][letter_Taken] > 0 ==>
  begin
    inbox_drone_1[me][letter_Taken] := inbox_drone_1[me][letter_Taken] - 1;
    at_drone_1[me] := in_drone_1_Land;
    look();
  end;
  rule "Free"
    at_drone_1[me] = in_drone_1_Land & inbox_drone_1[me][letter_Free] > 0 ==>
  begin
    inbox_drone_1[me][letter_Free] := inbox_drone_1[me][letter_Free] - 1;
    at_drone_1[me] := in_drone_1_Land;
    look();
  end;
  rule "Taken"
    at_drone_1[me] = in_drone_1_Wait & inbox_drone_1[me][letter_Taken] > 0 ==>
  begin
    inbox_drone_1[me][letter_Taken] := inbox_drone_1[me][letter_Taken] - 1;
    at_drone_1[me] := in_drone_1_Wait;
    look();
  end;
  rule "Free (landing.swarm:17)"
    at_drone_1[me] = in_drone_1_Wait & inbox_drone_1[me][letter_Free] > 0 ==>
  begin
    inbox_drone_1[me][letter_Free] := inbox_drone_1[me][letter_Free] - 1;
    at_drone_1[me] := in_drone_1_Circle;
    look();
  end;
end;

-- 1 drone: drone[0]
ruleset me: robot_drone_0 do
  rule "do.Circle.succeeded (landing.swarm:13)"
    at_drone_0[me] = in_drone_0_Circle ==>
  begin
    at_drone_0[me] := in_drone_0_Land;
    send_Taken_from_drone_0(me);
    count_0 := count_0 + 1;
    count_1 := count_1 + 1;
    look();
    count_0 := count_0 - 1;
    count_1 := count_1 - 1;
  end;
  rule "do.Circle.aborted (landing.swarm:14)"
    at_drone_0[me] = in_drone_0_Circle ==>
  begin
    at_drone_0[me] := in_drone_0_Circle;
    look();
  end;
  rule "Taken (landing.swarm:15)"
    at_drone_0[me] = in_drone_0_Circle & inbox_drone_0[me][letter_Taken] > 0 ==>
  begin
    inbox_drone_0[me][letter_Taken] := inbox_drone_0[me][letter_Taken] - 1;
    at_drone_0[me] := in_drone_0_Wait;
    look();
  end;
  rule "Free"
    at_drone_0[me] = in_drone_0_Circle & inbox_drone_0[me][letter_Free] > 0 ==>
  begin
    inbox_drone_0[me][letter_Free] := inbox_drone_0[me][letter_Free] - 1;
    at_drone_0[me] := in_drone_0_Circle;
    look();
  end;
  rule "do.Land.succeeded (landing.swarm:20)"
    at_drone_0[me] = in_drone_0_Land ==>
  begin
    at_drone_0[me] := in_drone_0_Down;
    end_drone_0(me);
    send_Free_from_drone_0(me);
    look();
  end;
  rule "do.Land.aborted (landing.swarm:21)"
    at_drone_0[me] = in_drone_0_Land ==>
  begin
    at_drone_0[me] := in_drone_0_Land;
    count_0 := count_0 + 1;
    look();
    count_0 := count_0 - 1;
  end;
  rule "Taken"
    at_drone_0[me] = in_drone_0_Land & inbox_drone_0[me][letter_Taken] > 0 ==>
  begin
    inbox_drone_0[me][letter_Taken] := inbox_drone_0[me][letter_Taken] - 1;
    at_drone_0[me] := in_drone_0_Land;
    look();
  end;
  rule "Free"
    at_drone_0[me] = in_drone_0_Land & inbox_drone_0[me][letter_Free] > 0 ==>
  begin
    inbox_drone_0[me][letter_Free] := inbox_drone_0[me][letter_Free] - 1;
    at_drone_0[me] := in_drone_0_Land;
    look();
  end;
  rule "Taken"
    at_drone_0[me] = in_drone_0_Wait & inbox_drone_0[me][letter_Taken] > 0 ==>
  begin
    inbox_drone_0[me][letter_Taken] := inbox_drone_0[me][letter_Taken] - 1;
    at_drone_0[me] := in_drone_0_Wait;
    look();
  end;
  rule "Free (landing.swarm:17)"
    at_drone_0[me] = in_drone_0_Wait & inbox_drone_0[me][letter_Free] > 0 ==>
  begin
    inbox_drone_0[me][letter_Free] := inbox_drone_0[me][letter_Free] - 1;
    at_drone_0[me] := in_drone_0_Circle;
    look();
  end;
end;

invariant "DownOnce" watch != VIOLATED;
