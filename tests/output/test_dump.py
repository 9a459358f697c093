"""The IR as text: everything that matters, nothing that does not."""

from swarmdsl.driver import pipeline
from swarmdsl.ir.dump import dump

MODEL = """
/// Lamps that blink.
package lamps
event Low : m/Level
message m/Level { level : float64 }
function blink : abstraction { action "cmd/blink" : m/Blink }
statemachine Blinking {
  param limit : duration = 1.5 s
  var tries : int32 = 0
  initial Blink
  state Blink {
    do blink
    on succeeded [tries < 3 and not (tries == 1)] / tries = tries + 1 -> Blink
    on succeeded -> Off
    on aborted   -> Off
    after limit  -> Off
  }
  final Off
}
environment Field { world "my field.world"; size 10 m x 20 m }
member Lamp { behavior Blinking }
swarm Lamps { lamp : Lamp[2..*]; environment Field }
"""


def test_a_state_machine_can_be_read(compiled):
    shown = dump(compiled(MODEL))
    assert shown.startswith("System lamps\n")
    machine = shown[shown.index("    StateMachine Blinking") : shown.index("  environments:")]
    assert machine == (
        "    StateMachine Blinking\n"
        "      initial: Blink\n"
        "      states:\n"
        "        State Blink\n"
        "          name: Blink\n"
        "          kind: simple\n"
        "          transitions:\n"
        "            Transition\n"
        "              triggers:\n"
        "                OutcomeTrigger state=Blink outcome=succeeded\n"
        "              guard: tries < 3 and not (tries == 1)\n"
        "              effects:\n"
        "                Assignment variable=tries value=tries + 1\n"
        "              target: Blink\n"
        "            Transition\n"
        "              triggers:\n"
        "                OutcomeTrigger state=Blink outcome=succeeded\n"
        "              target: Off\n"
        "            Transition\n"
        "              triggers:\n"
        "                OutcomeTrigger state=Blink outcome=aborted\n"
        "              target: Off\n"
        "            Transition\n"
        "              triggers:\n"
        "                TimeTrigger delay=limit\n"
        "              target: Off\n"
        "          activity:\n"
        "            Activity function=blink\n"
        "        State id=Off name=Off kind=final\n"
        "      variables:\n"
        "        Variable name=tries type=int32 initial=0\n"
        "      params:\n"
        "        Param name=limit type=duration default=1500 ms\n"
    )


def test_values_with_blanks_are_quoted(compiled):
    shown = dump(compiled(MODEL))
    assert 'Environment name=Field world="my field.world" size=10.0 20.0\n' in shown
    assert "Role name=lamp member=Lamp multiplicity=2..*\n" in shown


def test_the_example_is_shown_whole_and_without_places(examples):
    system = pipeline.check([examples / "search_and_rescue"]).system
    assert system is not None
    shown = dump(system)
    names = [state.id for machine in system.machines for state in machine.walk()]
    names += [member.name for member in system.members]
    names += [function.name for function in system.functions]
    assert [name for name in names if name not in shown] == []
    assert "Span" not in shown
    assert "Source" not in shown
    assert str(examples) not in shown
