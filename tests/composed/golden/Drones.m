-- Drones: 2 drone (landing.swarm:27)
--
-- messages between robots arrive in any order, none is lost
-- functions, delays and messages take any time
-- functions succeed or are aborted, actions are also preempted
-- no robot and no answer of a function is lost
--
-- rumur-run --deadlock-detection off Drones.m looks at all states.
-- Each rule is one step of a robot, with what leads to it in the model.

const
  ROBOTS: 2;
  CAPACITY: 2; -- of one event, on their way to a robot

type
  robot_drone: scalarset(2); -- 2 drone: drone[0], drone[1]
  state_drone: enum {
    in_drone_Circle, -- Circle
    in_drone_Land, -- Land
    in_drone_Wait, -- Wait
    in_drone_Down -- Down
  };
  letters: enum { -- events between robots
    letter_Taken, -- Taken
    letter_Free -- Free
  };
  inbox: array [letters] of 0..CAPACITY; -- how many of each are on their way to a robot

var
  at_drone: array [robot_drone] of state_drone;
  inbox_drone: array [robot_drone] of inbox;

procedure send_Taken_from_drone(me: robot_drone);
begin
  for other: robot_drone do
    if other != me & at_drone[other] != in_drone_Down & inbox_drone[other][letter_Taken] < CAPACITY then
      inbox_drone[other][letter_Taken] := inbox_drone[other][letter_Taken] + 1;
    end;
  end;
end;

procedure send_Free_from_drone(me: robot_drone);
begin
  for other: robot_drone do
    if other != me & at_drone[other] != in_drone_Down & inbox_drone[other][letter_Free] < CAPACITY then
      inbox_drone[other][letter_Free] := inbox_drone[other][letter_Free] + 1;
    end;
  end;
end;

-- What is on its way to a robot that has ended does not count.
procedure end_drone(me: robot_drone);
begin
  for each: letters do
    inbox_drone[me][each] := 0;
  end;
end;

startstate
begin
  for me: robot_drone do
    at_drone[me] := in_drone_Circle;
    inbox_drone[me][letter_Taken] := 0;
    inbox_drone[me][letter_Free] := 0;
  end;
end;

-- 2 drone: drone[0], drone[1]
ruleset me: robot_drone do
  rule "do.Circle.succeeded (landing.swarm:13)"
    at_drone[me] = in_drone_Circle ==>
  begin
    at_drone[me] := in_drone_Land;
    send_Taken_from_drone(me);
  end;
  rule "Taken (landing.swarm:15)"
    at_drone[me] = in_drone_Circle & inbox_drone[me][letter_Taken] > 0 ==>
  begin
    inbox_drone[me][letter_Taken] := inbox_drone[me][letter_Taken] - 1;
    at_drone[me] := in_drone_Wait;
  end;
  rule "Free"
    at_drone[me] = in_drone_Circle & inbox_drone[me][letter_Free] > 0 ==>
  begin
    inbox_drone[me][letter_Free] := inbox_drone[me][letter_Free] - 1;
    at_drone[me] := in_drone_Circle;
  end;
  rule "do.Land.succeeded (landing.swarm:20)"
    at_drone[me] = in_drone_Land ==>
  begin
    at_drone[me] := in_drone_Down;
    end_drone(me);
    send_Free_from_drone(me);
  end;
  rule "Taken"
    at_drone[me] = in_drone_Land & inbox_drone[me][letter_Taken] > 0 ==>
  begin
    inbox_drone[me][letter_Taken] := inbox_drone[me][letter_Taken] - 1;
    at_drone[me] := in_drone_Land;
  end;
  rule "Free"
    at_drone[me] = in_drone_Land & inbox_drone[me][letter_Free] > 0 ==>
  begin
    inbox_drone[me][letter_Free] := inbox_drone[me][letter_Free] - 1;
    at_drone[me] := in_drone_Land;
  end;
  rule "Taken"
    at_drone[me] = in_drone_Wait & inbox_drone[me][letter_Taken] > 0 ==>
  begin
    inbox_drone[me][letter_Taken] := inbox_drone[me][letter_Taken] - 1;
    at_drone[me] := in_drone_Wait;
  end;
  rule "Free (landing.swarm:17)"
    at_drone[me] = in_drone_Wait & inbox_drone[me][letter_Free] > 0 ==>
  begin
    inbox_drone[me][letter_Free] := inbox_drone[me][letter_Free] - 1;
    at_drone[me] := in_drone_Circle;
  end;
end;
