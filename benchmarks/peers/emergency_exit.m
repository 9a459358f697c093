-- examples/emergency_exit without time: N robots, and at most K of `SawExit` on the way to each.
const N: 6;
const K: 2;

type robot: scalarset(N);
type place: enum { Calm, Search, Leaving, Safe };

var at: array[robot] of place;
var waiting: array[robot] of 0..K;

procedure tell(me: robot);
begin
  for other: robot do
    if other != me & at[other] != Safe & waiting[other] < K then
      waiting[other] := waiting[other] + 1;
    end;
  end;
end;

startstate begin
  for i: robot do at[i] := Calm; waiting[i] := 0; end;
end;

ruleset i: robot do
  rule "alarm" at[i] = Calm ==> begin at[i] := Search; end;
  rule "ignored" (at[i] = Calm | at[i] = Leaving) & waiting[i] > 0 ==>
    begin waiting[i] := waiting[i] - 1; end;
  rule "found" at[i] = Search ==> begin at[i] := Leaving; tell(i); end;
  rule "told" at[i] = Search & waiting[i] > 0 ==>
    begin waiting[i] := waiting[i] - 1; at[i] := Leaving; end;
  rule "out" at[i] = Leaving ==> begin at[i] := Safe; waiting[i] := 0; end;
  rule "again" at[i] = Leaving ==> begin at[i] := Search; end;
end;
